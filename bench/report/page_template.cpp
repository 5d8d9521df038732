#include "bench/report/page_template.h"

#include <fmt/format.h>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::bench {
namespace {

/// Identifies our pages; part of the templates.
constexpr std::string_view mark = "<meta name=\"generator\" content=\"dustbench\">";

}  // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char letter : text) {
        if (letter == '&')
            safe += "&amp;";
        else if (letter == '<')
            safe += "&lt;";
        else if (letter == '"')
            safe += "&quot;";
        else
            safe += letter;
    }
    return safe;
}

std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& parts) {
    std::string result;
    for (std::size_t at = 0;;) {
        const std::size_t open = text.find("{{", at);
        const std::size_t close = open == std::string_view::npos ? open : text.find("}}", open);
        if (close == std::string_view::npos) return result.append(text.substr(at));
        result.append(text.substr(at, open - at));
        result.append(parts.at(std::string(text.substr(open + 2, close - open - 2))));
        at = close + 2;
    }
}

void requireOwnPage(const std::filesystem::path& folder, std::string_view name) {
    const std::filesystem::path file = folder / name;
    std::error_code none;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, none))) return;
    const std::string there = files::wholeText(file, "a dustbench report to replace", files::limits::geometryBytes);
    if (there.find(mark) == std::string::npos)
        throw InputError(
            fmt::format("'{}' exists and was not written by dustbench; move it away first", file.string()));
}

}  // namespace dustbench::bench
