#include "methods/kit/files/toml_nesting.h"

#include <algorithm>
#include <string>
#include <vector>

namespace dustbench::files {
namespace {

/// Reads a text once, from the left; strings and comments are skipped.
class NestingScan {
 public:
    explicit NestingScan(std::string_view text) : text_(text) {}

    std::size_t tooDeepLine(int levels) {
        while (at_ < text_.size()) {
            step(text_[at_]);
            if (depth() > levels) return line_;
        }
        return 0;
    }

 private:
    /// Levels of the header, of open brackets, and of the key being read.
    [[nodiscard]] int depth() const { return (open_.empty() ? header_ : open_.back()) + parts_; }

    void step(char letter) {
        switch (letter) {
            case '#':
                at_ = std::min(text_.find('\n', at_), text_.size());
                return;
            case '"':
            case '\'':
                return skipString(letter);
            case '\n':
                ++line_;
                if (open_.empty()) startLine();
                break;
            case '.':
                ++parts_;  // of a key; a number has one
                break;
            case '[':
            case '{':
                openBracket();
                break;
            case ']':
            case '}':
                closeBracket();
                break;
            case ',':
                parts_ = 0;
                break;
            case '=':
                isValue_ = true;
                break;
            default:
                break;
        }
        if (letter != '\n' && letter != ' ' && letter != '\t' && letter != '\r') startsLine_ = false;
        ++at_;
    }

    void startLine() {
        startsLine_ = true;
        isValue_ = isHeader_ = false;
        parts_ = 0;
    }

    void openBracket() {
        if (open_.empty() && (startsLine_ || (isHeader_ && !isValue_))) {
            if (!isHeader_) header_ = 1;
            isHeader_ = true;
            return;
        }
        open_.push_back(depth() + 1);
        parts_ = 0;
    }

    void closeBracket() {
        if (!open_.empty()) {
            open_.pop_back();
        } else if (isHeader_) {
            header_ += parts_;
        }
        parts_ = 0;
    }

    void skipString(char quote) {
        startsLine_ = false;
        const std::string three(3, quote);
        const std::string end = text_.substr(at_).starts_with(three) ? three : std::string(1, quote);
        for (at_ += end.size(); at_ < text_.size(); ++at_) {
            if (text_.substr(at_).starts_with(end)) {
                at_ += end.size();
                return;
            }
            if (text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size()) ++at_;
            if (text_[at_] != '\n') continue;
            if (end.size() == 1) return;  // invalid: the line end terminates the string
            ++line_;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0, line_ = 1;
    std::vector<int> open_;  ///< the depth within each open bracket
    int header_ = 0;         ///< levels of the table that the last header opened
    int parts_ = 0;          ///< dots of the key so far
    bool startsLine_ = true, isHeader_ = false, isValue_ = false;
};

}  // namespace

std::size_t tooDeepLine(std::string_view text, int levels) {
    return NestingScan(text).tooDeepLine(levels);
}

}  // namespace dustbench::files
