#include "methods/kit/meshes/mesh_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"

namespace dustbench::meshes {

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> list;
    constexpr std::string_view blank = " \t\r\f\v";
    for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
        list.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(blank, end);
    }
    return list;
}

std::string inQuotes(std::string_view text) {
    return fmt::format("'{}'", text.substr(0, 40));
}

bool Lines::next(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++number_;
    return true;
}

bool Lines::nextWords(std::vector<std::string_view>& words) {
    for (std::string_view line; next(line);) {
        words = wordsOf(line);
        if (!words.empty()) return true;
    }
    return false;
}

void Lines::fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), std::max<std::size_t>(number_, 1), what));
}

double Lines::number(std::string_view word) const {
    const auto value = parse<double>(word);
    if (!value || !std::isfinite(*value)) fail(fmt::format("got {}, expected a number", inQuotes(word)));
    return *value;
}

glm::vec3 Lines::vector(const std::vector<std::string_view>& words, std::size_t first) const {
    glm::vec3 point;
    for (int k = 0; k < 3; ++k) {
        const std::string_view word = words[first + static_cast<std::size_t>(k)];
        point[k] = static_cast<float>(number(word));
        if (!std::isfinite(point[k]))
            fail(fmt::format("got {}, expected a number in the range of a float", inQuotes(word)));
    }
    return point;
}

void Lines::requireLineEnd() const {
    if (text_.empty() || text_.back() != '\n')
        throw InputError(
            fmt::format("{}: the last line has no line end, so the file may be truncated; add one if it is complete",
                        file_.string()));
}

}  // namespace dustbench::meshes
