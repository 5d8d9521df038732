// Declares the arguments of a subcommand, and parses them. Only arguments.cpp uses the command line library.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's
class App;
class Option;
}  // namespace CLI

namespace dustbench::cli {

/// Options are named `--frames` (or `-P,--parameter`), positional arguments `id`. Values are checked during parsing: an
/// invalid one throws InputError with the option's name, the value and the allowed values.
class Arguments {
 public:
    explicit Arguments(CLI::App& app) : app_(app) {}

    void flag(const std::string& name, const std::string& help, bool& value);
    void text(const std::string& name, const std::string& placeholder, const std::string& help, std::string& value);
    /// A mandatory text option.
    void required(const std::string& name, const std::string& placeholder, const std::string& help, std::string& value);
    /// Positional, one or more.
    void requiredTexts(const std::string& name, const std::string& placeholder, const std::string& help,
                       std::vector<std::string>& values);
    /// May be given several times.
    void texts(const std::string& name, const std::string& placeholder, const std::string& help,
               std::vector<std::string>& values);
    /// May be given several times. `take` is called with each value during parsing, so that the order of different
    /// options is known. Mandatory if positional.
    void inOrder(const std::string& name, const std::string& placeholder, const std::string& help,
                 std::function<void(const std::string&)> take);
    void integer(const std::string& name, const std::string& help, std::int64_t& value, std::int64_t minimum,
                 std::int64_t maximum = std::numeric_limits<std::int64_t>::max());
    void number(const std::string& name, const std::string& help, double& value, double minimum, double maximum);
    /// Collects, during parsing, the names of the options that were given.
    void givenOptions(std::vector<std::string>& names);

 private:
    CLI::App& app_;
};

/// One subcommand: its arguments and its action. `run` returns the exit code.
struct Command {
    std::string name;
    std::string summary;
    std::string footer;  ///< below the options in its help
    std::function<void(Arguments&)> declare;
    std::function<int()> run;
};

/// Options of every subcommand, accepted before or after its name.
struct CommonOptions {
    std::function<void(Arguments&)> declare;
    std::function<void()> apply;  ///< before the subcommand runs
};

/// Parses the command line, runs the command and returns its exit code. `--help` and `--version` print and return 0.
/// Throws InputError for invalid usage.
[[nodiscard]] int dispatch(const std::vector<Command>& commands, const CommonOptions& common, std::string_view version,
                           const std::vector<std::string>& argv);

/// The arguments of a `dustbench` command without some options and their values.
[[nodiscard]] std::vector<std::string> withoutOptions(const std::vector<std::string>& words,
                                                      const std::vector<std::string>& options);

// --- Declarations as plain text, from which the manual page and the completions of shells are made

struct DeclaredOption {
    std::vector<std::string> names;  ///< `--frames`, `-P`; one word for a positional argument
    std::string placeholder;         ///< `N`, `FILE`, `svg|png|pdf`; empty for flags
    std::string help;
    std::string initial;  ///< default value; empty if there is none
    bool isPositional = false;
    bool isRequired = false;
    bool repeats = false;

    [[nodiscard]] bool takesValue() const { return isPositional || !placeholder.empty(); }
    /// The alternatives in a placeholder such as `svg|png|pdf`; none for other placeholders.
    [[nodiscard]] std::vector<std::string> words() const;
    /// `scenes` if the help contains "one of `dustbench list scenes`"; otherwise empty.
    [[nodiscard]] std::string listKind() const;
    [[nodiscard]] bool takesFile() const;
};

struct DeclaredCommand {
    std::string name;
    std::string summary;
    std::string footer;
    std::vector<DeclaredOption> options;
};

/// The declarations of the commands without the common options, and the common options with `--help`.
[[nodiscard]] std::vector<DeclaredCommand> declaredCommands(const std::vector<Command>& commands);
[[nodiscard]] std::vector<DeclaredOption> declaredOptions(const CommonOptions& common);

}  // namespace dustbench::cli
