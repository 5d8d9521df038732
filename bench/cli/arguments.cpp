#include "bench/cli/arguments.h"

#include <algorithm>
#include <charconv>
#include <CLI/CLI.hpp>
#include <iostream>
#include <regex>
#include <sstream>

#include "methods/contract/errors.h"

namespace dustbench::cli {
namespace {

template <typename Number>
std::function<void(const std::string&)> reader(const std::string& name, Number& value, Number minimum, Number maximum) {
    return [name, &value, minimum, maximum](const std::string& text) {
        Number number{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || end != text.data() + text.size() || !(number >= minimum && number <= maximum)) {
            const bool isTooLarge = error == std::errc::result_out_of_range && !text.starts_with('-');
            const bool unbounded = maximum == std::numeric_limits<Number>::max() && !isTooLarge;
            std::ostringstream allowed;
            allowed << (std::is_integral_v<Number> ? "integer " : "number ") << minimum
                    << (unbounded ? " or more" : "..");
            if (!unbounded) allowed << maximum;
            throw InputError(name + ": got '" + text + "', allowed: " + allowed.str());
        }
        value = number;
    };
}

template <typename Number>
void declareNumber(CLI::App& app, const std::string& name, const std::string& help, Number& value, Number minimum,
                   Number maximum) {
    std::ostringstream initial;
    initial << value;
    app.add_option_function<std::string>(name, reader(name, value, minimum, maximum), help)
        ->type_name("N")
        ->default_str(initial.str());
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_positional()) names.push_back(option->get_name());
    return names;
}

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* each : app.get_subcommands({})) names.push_back(each->get_name());
    return names;
}

/// `help` is `--help`, and `help run` is `run --help`.
std::vector<std::string> withHelpAsOption(const CLI::App& app, std::vector<std::string> argv) {
    if (argv.empty() || argv.front() != "help") return argv;
    if (argv.size() > 2) throw InputError("help: got more than one command, allowed: one or none");
    if (argv.size() == 1) return {"--help"};
    const std::vector<std::string> known = commandNames(app);
    if (std::ranges::find(known, argv[1]) == known.end()) throw unknownName("command", argv[1], known);
    return {argv[1], "--help"};
}

/// Suggests a name close to an unknown option or subcommand.
InputError unexpected(const CLI::App& app, const CLI::App* command, const std::vector<std::string>& argv,
                      const CLI::ParseError& error) {
    if (!command) {
        const std::vector<std::string> words = withoutOptions(argv, optionNames(app));
        if (words.empty()) return InputError("no command given; `dustbench help` lists the commands");
        if (words.front().starts_with('-')) return unknownName("option", words.front(), optionNames(app));
        return unknownName("command", words.front(), commandNames(app));
    }
    for (const std::string& word : argv) {
        const std::string name = word.substr(0, word.find('='));
        if (name.size() > 1 && name.front() == '-' && !command->get_option_no_throw(name))
            return unknownName("option of " + command->get_name(), name, optionNames(*command));
    }
    return InputError(error.what());
}

DeclaredOption declaredOption(const CLI::Option& option) {
    DeclaredOption declared;
    for (const std::string& name : option.get_snames()) declared.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) declared.names.push_back("--" + name);
    declared.isPositional = option.get_positional();
    if (declared.isPositional) declared.names = {option.get_name()};
    if (option.get_type_size_max() > 0) declared.placeholder = option.get_type_name();
    declared.help = option.get_description();
    declared.initial = option.get_default_str();
    declared.isRequired = option.get_required();
    declared.repeats =
        option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    return declared;
}

std::vector<DeclaredOption> declaredOptionsOf(const CLI::App& app) {
    std::vector<DeclaredOption> options;
    for (const CLI::Option* option : app.get_options()) options.push_back(declaredOption(*option));
    return options;
}

}  // namespace

std::vector<std::string> DeclaredOption::words() const {
    static const std::regex list("[a-z0-9_]+(\\|[a-z0-9_]+)+", std::regex::optimize);
    std::vector<std::string> words;
    if (!std::regex_match(placeholder, list)) return words;
    std::istringstream text(placeholder);
    for (std::string word; std::getline(text, word, '|');) words.push_back(word);
    return words;
}

std::string DeclaredOption::listKind() const {
    static const std::regex reference("one of `dustbench list ([a-z]+)`", std::regex::optimize);
    std::smatch found;
    return std::regex_search(help, found, reference) ? found[1].str() : "";
}

bool DeclaredOption::takesFile() const {
    return placeholder.find("FILE") != std::string::npos || placeholder.find("DIR") != std::string::npos ||
           help.find("file") != std::string::npos;
}

std::vector<DeclaredCommand> declaredCommands(const std::vector<Command>& commands) {
    std::vector<DeclaredCommand> declared;
    for (const Command& command : commands) {
        CLI::App app;
        app.set_help_flag();
        Arguments arguments(app);
        command.declare(arguments);
        declared.push_back({command.name, command.summary, command.footer, declaredOptionsOf(app)});
    }
    return declared;
}

std::vector<DeclaredOption> declaredOptions(const CommonOptions& common) {
    CLI::App app;
    Arguments arguments(app);
    common.declare(arguments);
    return declaredOptionsOf(app);
}

void Arguments::flag(const std::string& name, const std::string& help, bool& value) {
    app_.add_flag(name, value, help);
}

void Arguments::text(const std::string& name, const std::string& placeholder, const std::string& help,
                     std::string& value) {
    CLI::Option* option = app_.add_option(name, value, help)->type_name(placeholder);
    if (!value.empty()) option->capture_default_str();
}

void Arguments::required(const std::string& name, const std::string& placeholder, const std::string& help,
                         std::string& value) {
    app_.add_option(name, value, help)->type_name(placeholder)->required();
}

void Arguments::requiredTexts(const std::string& name, const std::string& placeholder, const std::string& help,
                              std::vector<std::string>& values) {
    app_.add_option(name, values, help)->type_name(placeholder)->required()->expected(-1);
}

void Arguments::texts(const std::string& name, const std::string& placeholder, const std::string& help,
                      std::vector<std::string>& values) {
    app_.add_option(name, values, help)->type_name(placeholder)->allow_extra_args(false)->type_size(1);
}

void Arguments::inOrder(const std::string& name, const std::string& placeholder, const std::string& help,
                        std::function<void(const std::string&)> take) {
    const auto takeAll = [take = std::move(take)](const CLI::results_t& values) {
        std::ranges::for_each(values, take);
        return true;
    };
    CLI::Option* option =
        app_.add_option(name, takeAll, help)->type_name(placeholder)->required(!name.starts_with('-'));
    option->trigger_on_parse()->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void Arguments::integer(const std::string& name, const std::string& help, std::int64_t& value, std::int64_t minimum,
                        std::int64_t maximum) {
    declareNumber(app_, name, help, value, minimum, maximum);
}

void Arguments::number(const std::string& name, const std::string& help, double& value, double minimum,
                       double maximum) {
    declareNumber(app_, name, help, value, minimum, maximum);
}

void Arguments::givenOptions(std::vector<std::string>& names) {
    app_.parse_complete_callback([&app = app_, &names] {
        for (const CLI::Option* option : app.get_options())
            if (option->count() > 0 && !option->get_positional()) names.push_back(option->get_name());
    });
}

int dispatch(const std::vector<Command>& commands, const CommonOptions& common, std::string_view version,
             const std::vector<std::string>& argv) {
    CLI::App app("Compares and benchmarks methods for real-time volumetric effects.", "dustbench");
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    app.set_version_flag("--version", std::string(version));
    Arguments before(app);
    common.declare(before);
    std::vector<std::pair<CLI::App*, const Command*>> declared;
    for (const Command& command : commands) {
        CLI::App* sub = app.add_subcommand(command.name, command.summary);
        sub->footer(command.footer);
        Arguments arguments(*sub);
        command.declare(arguments);
        common.declare(arguments);
        declared.emplace_back(sub, &command);
    }

    const auto chosen = [&]() -> const std::pair<CLI::App*, const Command*>* {
        for (const auto& entry : declared)
            if (entry.first->parsed() || entry.first->count() > 0) return &entry;
        return nullptr;
    };
    try {
        std::vector<std::string> reversed = withHelpAsOption(app, argv);
        std::ranges::reverse(reversed);
        app.parse(std::move(reversed));
    } catch (const CLI::CallForVersion& call) {
        std::cout << call.what() << '\n';
        return 0;
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return 0;
    } catch (const CLI::ParseError& error) {
        const auto* entry = chosen();
        // Caught by type, because a subcommand's ExtrasError has the name of the subcommand.
        if (dynamic_cast<const CLI::ExtrasError*>(&error) || !entry)
            throw unexpected(app, entry ? entry->first : nullptr, argv, error);
        const std::string_view text = error.what();
        if (const std::size_t end = text.find(": At Most 1 required"); end != std::string_view::npos)
            throw InputError(std::string(text.substr(0, end)) + ": given more than once");
        throw InputError(error.what());
    }
    common.apply();
    return chosen()->second->run();
}

std::vector<std::string> withoutOptions(const std::vector<std::string>& words,
                                        const std::vector<std::string>& options) {
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string name = words[i].substr(0, words[i].find('='));
        if (std::ranges::find(options, name) == options.end())
            rest.push_back(words[i]);
        else if (name == words[i])
            ++i;
    }
    return rest;
}

}  // namespace dustbench::cli
