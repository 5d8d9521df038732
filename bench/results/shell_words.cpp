#include "bench/results/shell_words.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "methods/contract/errors.h"

namespace dustbench::results {
namespace {

/// The characters that a backslash escapes within double quotes.
constexpr std::string_view escapable = "\"\\$`\n";

/// Splits one line into words, character by character.
class Splitter {
 public:
    explicit Splitter(std::string_view line) : line_(line) {}

    std::vector<std::string> words() {
        while (at_ < line_.size()) readLetter();
        endWord();
        return std::move(words_);
    }

 private:
    void readLetter() {
        const char letter = line_[at_++];
        if (std::isspace(static_cast<unsigned char>(letter))) return endWord();
        if (letter == '\\' && at_ < line_.size() && line_[at_] == '\n') {
            ++at_;
            return;
        }
        inWord_ = true;
        if (letter == '\\' && at_ < line_.size())
            word_.push_back(line_[at_++]);
        else if (letter == '\'' || letter == '"')
            readQuoted(letter);
        else
            word_.push_back(letter);
    }
    void readQuoted(char quote) {
        for (; at_ < line_.size(); ++at_) {
            if (line_[at_] == quote) {
                ++at_;
                return;
            }
            const bool escapes = quote == '"' && line_[at_] == '\\' && at_ + 1 < line_.size() &&
                                 escapable.find(line_[at_ + 1]) != std::string_view::npos;
            if (escapes) ++at_;
            word_.push_back(line_[at_]);
        }
        throw InputError("command line: a quote " + std::string(1, quote) + " is not closed");
    }
    void endWord() {
        if (inWord_) words_.push_back(std::exchange(word_, {}));
        inWord_ = false;
    }

    std::string_view line_;
    std::size_t at_ = 0;
    std::string word_;
    bool inWord_ = false;  ///< a word may be empty
    std::vector<std::string> words_;
};

}  // namespace

std::string shellQuoted(const std::string& text) {
    const bool plain = !text.empty() && std::ranges::all_of(text, [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) ||
               std::string_view("_-./:,=+@").find(letter) != std::string_view::npos;
    });
    if (plain) return text;
    std::string quoted = "'";
    for (const char letter : text) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

std::vector<std::string> shellWords(std::string_view line) {
    return Splitter(line).words();
}

}  // namespace dustbench::results
