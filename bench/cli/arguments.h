// Declares what a subcommand takes. The command line library behind it stays in one source file.
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

/// Options are named `--frames` (or `-P,--parameter`), positional arguments `id`. Values are checked when parsed: what
/// is not allowed throws InputError with name, what was got and what is allowed.
class Arguments {
 public:
    explicit Arguments(CLI::App& app) : app_(app) {}

    void flag(const std::string& name, const std::string& help, bool& value);
    void text(const std::string& name, const std::string& placeholder, const std::string& help, std::string& value);
    /// A text that must be given.
    void required(const std::string& name, const std::string& placeholder, const std::string& help, std::string& value);
    /// Positional, one or more.
    void requiredTexts(const std::string& name, const std::string& placeholder, const std::string& help,
                       std::vector<std::string>& values);
    /// May be given several times.
    void texts(const std::string& name, const std::string& placeholder, const std::string& help,
               std::vector<std::string>& values);
    void integer(const std::string& name, const std::string& help, std::int64_t& value, std::int64_t minimum,
                 std::int64_t maximum = std::numeric_limits<std::int64_t>::max());
    void number(const std::string& name, const std::string& help, double& value, double minimum, double maximum);
    /// When parsed: the names of the options that were given.
    void givenOptions(std::vector<std::string>& names);

 private:
    CLI::App& app_;
};

/// One subcommand: what it takes and what it does. `run` gives the exit code.
struct Command {
    std::string name;
    std::string summary;
    std::string footer;  ///< below the options in its help
    std::function<void(Arguments&)> declare;
    std::function<int()> run;
};

/// Options that every subcommand takes, before or after its name.
struct CommonOptions {
    std::function<void(Arguments&)> declare;
    std::function<void()> apply;  ///< before the subcommand runs
};

/// Parses the command line, runs the command that it names and gives the exit code. `--help` and `--version` print and
/// give 0. Throws InputError for wrong use.
[[nodiscard]] int dispatch(const std::vector<Command>& commands, const CommonOptions& common, std::string_view version,
                           const std::vector<std::string>& argv);

}  // namespace dustbench::cli
