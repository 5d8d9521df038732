// Mutates the bytes of a file at random, like accidental damage and forgery.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

namespace dustbench::fuzz {

/// The same seed gives the same mutants.
class Mutation {
 public:
    explicit Mutation(std::uint32_t seed) : random_(seed) {}

    /// One to eight changes.
    [[nodiscard]] std::string operator()(std::string text) {
        for (std::size_t n = 1 + below(8); n > 0 && !text.empty(); --n) change(text);
        return text;
    }

 private:
    std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

    void change(std::string& text) {
        const std::size_t at = below(text.size()), length = 1 + below(16);
        switch (below(8)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
                break;
            case 2:
                text.erase(at, length);
                break;
            case 3:
                text.insert(at, text.substr(below(text.size()), length));
                break;
            case 4:
                text.resize(at);
                break;
            case 5:
                text.replace(at, 4, std::string(4, below(2) == 0 ? '\xff' : '\0'));
                break;
            case 6:
                eraseLine(text, at);
                break;
            default:
                replaceNumber(text, at);
        }
    }

    static void eraseLine(std::string& text, std::size_t at) {
        const std::size_t begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
        text.erase(begin, text.find('\n', at) - begin + 1);
    }

    /// Replaces the number after the position by a limit value.
    void replaceNumber(std::string& text, std::size_t at) {
        static constexpr std::array<std::string_view, 14> numbers{
            "0",   "-1",   "1",       "255",   "65536",     "2147483647",           "2147483648",
            "nan", "1e39", "-1e-310", "1e999", "999999999", "-9223372036854775808", "18446744073709551616"};
        const std::size_t begin = text.find_first_of("0123456789", at);
        if (begin == std::string::npos) return;
        const std::size_t end = std::min(text.find_first_not_of("0123456789.e+-", begin), text.size());
        text.replace(begin, end - begin, numbers[below(numbers.size())]);
    }

    std::mt19937 random_;
};

}  // namespace dustbench::fuzz
