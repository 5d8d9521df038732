#include "bench/cli/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

// bash

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

// zsh

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

// fish

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

}  // namespace

const std::vector<std::string>& completedShells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string completionScript(std::string_view shell, const std::vector<DeclaredCommand>& commands,
                             const std::vector<DeclaredOption>& common) {
    if (shell == "bash") return bashScript(commands, common);
    return shell == "zsh" ? zshScript(commands, common) : fishScript(commands, common);
}

}  // namespace dustbench::cli
