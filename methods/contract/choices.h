// Maps the words of a choice to enumerators: one table serves to declare, parse and print it.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/errors.h"

namespace dustbench {

template <typename Enumeration>
struct Choice {
    std::string_view word;
    Enumeration value{};
};

/// `inline constexpr Choices<Facing> facings{{"viewpoint", Facing::viewpoint}, {"viewplane", Facing::viewplane}};`
/// Words and enumerators are unique, which the compiler checks.
template <typename Enumeration>
class Choices {
 public:
    static constexpr std::size_t maximum = 16;

    consteval Choices(std::initializer_list<Choice<Enumeration>> choices) : count_(choices.size()) {
        if (choices.size() > maximum) throw std::logic_error("more choices than a table holds");
        std::ranges::copy(choices, choices_.begin());
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (choices_[i].word == choices_[k].word || choices_[i].value == choices_[k].value)
                    throw std::logic_error("a word or an enumerator occurs twice");
    }

    /// In table order.
    [[nodiscard]] std::span<const Choice<Enumeration>> all() const { return {choices_.data(), count_}; }
    [[nodiscard]] std::vector<std::string> words() const {
        std::vector<std::string> words;
        for (const auto& choice : all()) words.emplace_back(choice.word);
        return words;
    }

    [[nodiscard]] std::string_view wordOf(Enumeration value) const {
        const auto found = std::ranges::find(all(), value, &Choice<Enumeration>::value);
        if (found == all().end()) throw std::logic_error("an enumerator is not in the table of its words");
        return found->word;
    }
    [[nodiscard]] std::optional<Enumeration> find(std::string_view word) const {
        const auto found = std::ranges::find(all(), word, &Choice<Enumeration>::word);
        return found == all().end() ? std::nullopt : std::optional(found->value);
    }
    /// For a word that has already been validated.
    [[nodiscard]] Enumeration valueOf(std::string_view word) const {
        if (const auto value = find(word)) return *value;
        throw std::logic_error("'" + std::string(word) + "' is not in the table of words");
    }
    /// Throws InputError: `sync: got 'never', allowed: frame|stage|none`.
    [[nodiscard]] Enumeration parse(std::string_view what, std::string_view word) const {
        if (const auto value = find(word)) return *value;
        std::string allowed;
        for (const auto& choice : all()) allowed.append(allowed.empty() ? "" : "|").append(choice.word);
        throw InputError(std::string(what) + ": got '" + std::string(word) + "', allowed: " + allowed);
    }

 private:
    std::array<Choice<Enumeration>, maximum> choices_{};
    std::size_t count_;
};

}  // namespace dustbench
