// `dustbench completion` and `dustbench manual`: print shell completions and the manual page, which packages install.
// Both are made from the declarations of the subcommands.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/cli/arguments.h"
#include "bench/cli/commands.h"
#include "bench/measure/provenance.h"
#include "methods/contract/errors.h"

namespace dustbench::cli {
namespace {

/// Quotes any text for a shell: 'it'\''s'.
std::string inQuotes(std::string_view text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

std::string idsOf(const std::string& kind) {
    return fmt::format("dustbench list {} --ids 2> /dev/null", kind);
}

/// Names of options, without positional arguments.
std::vector<std::string> namesOf(const std::vector<DeclaredOption>& options) {
    std::vector<std::string> names;
    for (const DeclaredOption& option : options)
        if (!option.isPositional) names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::vector<DeclaredOption> optionsOf(const DeclaredCommand& command, const std::vector<DeclaredOption>& common) {
    std::vector<DeclaredOption> all = command.options;
    all.insert(all.end(), common.begin(), common.end());
    return all;
}

const DeclaredOption* positionalOf(const DeclaredCommand& command) {
    const auto found = std::ranges::find_if(command.options, &DeclaredOption::isPositional);
    return found == command.options.end() ? nullptr : &*found;
}

// --- Completion by bash

/// Fills COMPREPLY with the possible values of an option.
std::string bashValue(const DeclaredOption& option) {
    const std::string files = "compgen -f -- \"$word\"";
    if (const auto words = option.words(); !words.empty())
        return fmt::format("_dustbench_reply \"$(compgen -W '{}' -- \"$word\")\"", fmt::join(words, " "));
    if (const std::string kind = option.listKind(); !kind.empty())
        return fmt::format("_dustbench_reply \"$(compgen -W \"$({})\" -- \"$word\"{})\"", idsOf(kind),
                           option.takesFile() ? "; " + files : "");
    return option.takesFile() ? fmt::format("_dustbench_reply \"$({})\"", files) : ":";
}

std::string bashCases(const std::string& command, const std::vector<DeclaredOption>& options) {
    std::string text;
    for (const DeclaredOption& option : options) {
        if (option.isPositional || !option.takesValue()) continue;
        std::vector<std::string> patterns;
        patterns.reserve(option.names.size());
        for (const std::string& name : option.names) patterns.push_back(inQuotes(command + " " + name));
        text += fmt::format("        {}) {}; return ;;\n", fmt::join(patterns, " | "), bashValue(option));
    }
    return text;
}

std::string bashScript(const std::vector<DeclaredCommand>& commands, const std::vector<DeclaredOption>& common) {
    std::vector<std::string> names, valued;
    std::string values = bashCases("", common), rest;
    for (const DeclaredCommand& command : commands) {
        const std::vector<DeclaredOption> options = optionsOf(command, common);
        names.push_back(command.name);
        values += bashCases(command.name, options);
        const DeclaredOption* positional = positionalOf(command);
        rest += fmt::format(
            "        {}) [[ $word == -* ]] && _dustbench_reply \"$(compgen -W '{}' -- \"$word\")\" || {} ;;\n",
            command.name, fmt::join(namesOf(options), " "), positional ? bashValue(*positional) : ":");
    }
    for (const DeclaredOption& option : common)
        if (option.takesValue()) valued.insert(valued.end(), option.names.begin(), option.names.end());
    return fmt::format(
        R"bash(# dustbench(1) for bash, by `dustbench completion bash`.
_dustbench_reply() {{
    mapfile -t COMPREPLY < <([[ -z $1 ]] || printf '%s\n' "$1")
}}
_dustbench() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command= i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${{COMP_WORDS[i]}} in
            {}) [[ ${{COMP_WORDS[i+1]}} == = ]] && ((++i)); ((++i)) ;;
            -*) ;;
            *) command=${{COMP_WORDS[i]}}; break ;;
        esac
    done
    COMPREPLY=()
    # `--name=value` is three words.
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = ]]; then
        before=${{COMP_WORDS[COMP_CWORD-2]}}
    fi
    case "$command $before" in
{}    esac
    case $command in
        '') _dustbench_reply "$(compgen -W '{} {} --version' -- "$word")" ;;
{}    esac
}}
complete -o filenames -o bashdefault -F _dustbench dustbench
)bash",
        fmt::join(valued, " | "), values, fmt::join(names, " "), fmt::join(namesOf(common), " "), rest);
}

// --- Completion by zsh

/// Escapes text for `[…]` in a specification of _arguments.
std::string zshText(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
        result += c;
    }
    return result;
}

std::string zshValue(const DeclaredOption& option) {
    if (const auto words = option.words(); !words.empty()) return fmt::format("({})", fmt::join(words, " "));
    if (const std::string kind = option.listKind(); !kind.empty())
        return fmt::format("{{_dustbench_ids {}{}}}", kind, option.takesFile() ? "; _files" : "");
    return option.takesFile() ? "_files" : " ";
}

void addZshSpecifications(std::string& text, const std::vector<DeclaredOption>& options, const char* indent) {
    for (const DeclaredOption& option : options) {
        const std::string message = option.placeholder.empty() ? option.names.front() : zshText(option.placeholder);
        const std::string value = fmt::format(":{}:{}", message, zshValue(option));
        if (option.isPositional) {
            text += fmt::format(" \\\n{}{}", indent, inQuotes((option.repeats ? "*" : "") + value));
            continue;
        }
        for (const std::string& name : option.names)
            text += fmt::format(" \\\n{}{}", indent,
                                inQuotes((option.repeats ? "*" : "") + name + "[" + zshText(option.help) + "]" +
                                         (option.takesValue() ? value : "")));
    }
}

std::string zshScript(const std::vector<DeclaredCommand>& commands, const std::vector<DeclaredOption>& common) {
    std::string text =
        "#compdef dustbench\n"
        "# dustbench(1) for zsh, by `dustbench completion zsh`.\n"
        "_dustbench_ids() {\n"
        "    local -a ids\n"
        "    ids=(${(f)\"$(dustbench list $1 --ids 2> /dev/null)\"})\n"
        "    compadd -a ids\n"
        "}\n"
        "_dustbench() {\n"
        "    local -a commands line\n"
        "    local state\n"
        "    commands=(";
    for (const DeclaredCommand& command : commands)
        text += "\n        " + inQuotes(zshText(command.name) + ":" + command.summary);
    text += "\n    )\n    _arguments -C";
    addZshSpecifications(text, common, "        ");
    text +=
        " \\\n        '--version[print the version]' '1:command:->command' '*::argument:->argument'\n"
        "    case $state in\n"
        "        command) _describe command commands ;;\n"
        "        argument)\n"
        "            case $line[1] in\n";
    for (const DeclaredCommand& command : commands) {
        text += fmt::format("                {}) _arguments", command.name);
        addZshSpecifications(text, optionsOf(command, common), "                    ");
        text += " ;;\n";
    }
    text +=
        "            esac ;;\n"
        "    esac\n"
        "}\n"
        "_dustbench \"$@\"\n";
    return text;
}

// --- Completion by fish

std::string fishValue(const DeclaredOption& option) {
    if (const auto words = option.words(); !words.empty())
        return " -x -a " + inQuotes(fmt::format("{}", fmt::join(words, " ")));
    if (const std::string kind = option.listKind(); !kind.empty())
        return (option.takesFile() ? " -r -a " : " -x -a ") + inQuotes("(" + idsOf(kind) + ")");
    return option.takesFile() ? " -r -F" : " -x";
}

std::string fishLine(const std::string& condition, const DeclaredOption& option) {
    std::string line = "complete -c dustbench" + condition;
    for (const std::string& name : option.names)
        if (!option.isPositional)
            line += (name.starts_with("--") ? " -l " : " -s ") + name.substr(name.rfind('-', 1) + 1);
    if (option.takesValue()) line += fishValue(option);
    return line + (option.isPositional ? "" : " -d " + inQuotes(option.help)) + "\n";
}

std::string fishScript(const std::vector<DeclaredCommand>& commands, const std::vector<DeclaredOption>& common) {
    std::string text = "# dustbench(1) for fish, by `dustbench completion fish`.\ncomplete -c dustbench -f\n";
    for (const DeclaredOption& option : common) text += fishLine("", option);
    text += "complete -c dustbench -n __fish_use_subcommand -l version -d 'print the version'\n";
    for (const DeclaredCommand& command : commands)
        text += fmt::format("complete -c dustbench -n __fish_use_subcommand -a {} -d {}\n", command.name,
                            inQuotes(command.summary));
    for (const DeclaredCommand& command : commands) {
        const std::string condition = " -n " + inQuotes("__fish_seen_subcommand_from " + command.name);
        for (const DeclaredOption& option : command.options) text += fishLine(condition, option);
    }
    return text;
}

// --- Completion by any of them

const std::vector<std::string>& completedShells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

/// The script for one of completedShells(). `common`: options of every command, before or after its name. Names of
/// methods, scenes and so on are queried with `dustbench list` during completion.
std::string completionScript(std::string_view shell, const std::vector<DeclaredCommand>& commands,
                             const std::vector<DeclaredOption>& common) {
    if (shell == "bash") return bashScript(commands, common);
    return shell == "zsh" ? zshScript(commands, common) : fishScript(commands, common);
}

// --- The manual page

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

/// In the format of man(7). `common`: options of every command.
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

// --- The commands

Command completionCommand(std::function<int(const std::string&)> complete) {
    auto shell = std::make_shared<std::string>();
    return {"completion", "Print the script with which a shell completes dustbench's command line",
            "To use it in this bash session: `source <(dustbench completion bash)`.",
            [shell](Arguments& arguments) { arguments.required("shell", "bash|zsh|fish", "the shell", *shell); },
            [shell, complete = std::move(complete)] { return complete(*shell); }};
}

Command manualCommand(std::function<int()> print) {
    return {"manual", "Print the manual page", "To read it: `dustbench manual | man -l -`.", [](Arguments&) {},
            std::move(print)};
}

}  // namespace

std::vector<Command> manualCommands(const std::vector<Command>& commands, const CommonOptions& common) {
    auto all = std::make_shared<std::vector<DeclaredCommand>>(declaredCommands(commands));
    auto options = declaredOptions(common);
    std::vector<Command> added{completionCommand([all, options](const std::string& shell) {
                                   if (std::ranges::find(completedShells(), shell) == completedShells().end())
                                       throw unknownName("shell", shell, completedShells());
                                   std::cout << completionScript(shell, *all, options);
                                   return int{exitOk};
                               }),
                               manualCommand([all, options] {
                                   std::cout << manPage(*all, options, measure::buildFacts().version);
                                   return int{exitOk};
                               })};
    std::ranges::move(declaredCommands(added), std::back_inserter(*all));
    return added;
}

}  // namespace dustbench::cli
