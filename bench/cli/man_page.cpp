#include "bench/cli/man_page.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "bench/cli/exit_codes.h"

namespace dustbench::cli {
namespace {

/// The UTF-8 character that begins at `at`; moves `at` past it.
std::uint32_t nextCharacter(std::string_view text, std::size_t& at) {
    const auto byte = static_cast<unsigned char>(text[at++]);
    if (byte < 0x80) return byte;
    const int more = byte >= 0xF0 ? 3 : (byte >= 0xE0 ? 2 : 1);
    std::uint32_t code = byte & (0x3FU >> more);
    for (int i = 0; i < more && at < text.size(); ++i)
        code = code << 6U | (static_cast<unsigned char>(text[at++]) & 0x3FU);
    return code;
}

/// Escapes text for roff, so that nothing in it is read as a request or an escape. Characters outside ASCII become
/// numbers.
std::string literal(std::string_view text) {
    std::string result;
    bool isLineStart = true;
    for (std::size_t at = 0; at < text.size();) {
        const std::uint32_t c = nextCharacter(text, at);
        if (isLineStart && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c < 0x80 ? std::string(1, static_cast<char>(c)) : fmt::format("\\[u{:04X}]", c);
        isLineStart = c == '\n';
    }
    return result;
}

/// Text with a full stop, unless it ends with one or with an ellipsis.
std::string sentence(std::string_view text) {
    const bool hasEnd = text.ends_with('.') || text.ends_with("…");
    return literal(text) + (hasEnd ? "" : ".");
}

/// `\fB--size\fP \fIWxH\fP`, `\fIdir\fP`
std::string term(const DeclaredOption& option) {
    std::string text;
    for (const std::string& name : option.names) {
        if (!text.empty()) text += ", ";
        text += fmt::format("\\f{}{}\\fP", option.isPositional ? 'I' : 'B', literal(name));
    }
    if (!option.isPositional && option.takesValue()) text += fmt::format(" \\fI{}\\fP", literal(option.placeholder));
    return text;
}

std::string paragraph(const DeclaredOption& option) {
    std::string text = fmt::format(".TP\n{}\n{}", term(option), literal(option.help));
    if (!option.initial.empty()) text += literal(fmt::format("; default: {}", option.initial));
    if (option.isRequired && !option.isPositional) text += " (required)";
    return text + "\n";
}

/// `.B dustbench run --method ID --out DIR [OPTIONS]`: the required options.
std::string synopsis(const DeclaredCommand& command) {
    std::string text = fmt::format("\\fBdustbench {}\\fP", literal(command.name));
    for (const DeclaredOption& option : command.options) {
        if (!option.isPositional && !option.isRequired) continue;
        const std::string shown = term(option) + (option.repeats ? " ..." : "");
        text += option.isRequired ? " " + shown : " [" + shown + "]";
    }
    return text + " [OPTIONS]";
}

constexpr std::array<std::pair<int, const char*>, 7> exitStatuses{
    {{exitOk, "Success."},
     {exitRunFailed,
      "A run failed or timed out; the others were completed. verify: a repeated simulation differs from the bundle."},
     {exitAborted, "Interrupted, or a resource such as disk space ran out. Repeat the command to resume."},
     {exitBadInput, "Wrong usage, invalid input or no OpenGL; nothing was measured."},
     {exitInternal, "Internal error: a bug in dustbench."},
     {exitRegression,
      "compare --fail-on-regression: the second folder is slower than allowed, or a run fails only there. recommend: "
      "nothing fits the budget."},
     {exitNotComparable,
      "compare, report: the folders are not comparable. recommend: no setting has both a time and a quality."}}};

}  // namespace

std::string manPage(const std::vector<DeclaredCommand>& commands, const std::vector<DeclaredOption>& common,
                    const std::string& version) {
    std::string page = fmt::format(
        ".TH DUSTBENCH 1 \"\" \"dustbench {}\" \"User Commands\"\n"
        ".SH NAME\ndustbench \\- compare and benchmark methods for real\\-time volumetric effects\n"
        ".SH SYNOPSIS\n.B dustbench\n.I COMMAND\n[OPTIONS]\n.SH COMMANDS\n",
        literal(version));
    for (const DeclaredCommand& command : commands)
        page += fmt::format(".TP\n\\fB{}\\fP\n{}\n", literal(command.name), sentence(command.summary));
    page += ".SH OPTIONS OF EVERY COMMAND\n";
    for (const DeclaredOption& option : common) page += paragraph(option);
    for (const DeclaredCommand& command : commands) {
        page +=
            fmt::format(".SH {}\n{}\n.PP\n{}\n", literal(command.name), synopsis(command), sentence(command.summary));
        for (const DeclaredOption& option : command.options) page += paragraph(option);
        if (!command.footer.empty()) page += fmt::format(".PP\n{}\n", literal(command.footer));
    }
    page += ".SH EXIT STATUS\n";
    for (const auto& [status, meaning] : exitStatuses) page += fmt::format(".TP\n{}\n{}\n", status, literal(meaning));
    return page;
}

}  // namespace dustbench::cli
