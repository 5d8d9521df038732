// The declaration of a subcommand as plain text, from which the manual page and shell completions are generated.
#pragma once

#include <string>
#include <vector>

namespace dustbench::cli {

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

}  // namespace dustbench::cli
