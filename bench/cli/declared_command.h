// What a subcommand declares, as plain text: the source of the man page and of the completions of shells.
#pragma once

#include <string>
#include <vector>

namespace dustbench::cli {

struct DeclaredOption {
    std::vector<std::string> names;  ///< `--frames`, `-P`; one word for a positional argument
    std::string placeholder;         ///< `N`, `FILE`, `svg|png|pdf`; empty for flags
    std::string help;
    std::string initial;  ///< empty: none
    bool isPositional = false;
    bool isRequired = false;
    bool repeats = false;

    [[nodiscard]] bool takesValue() const { return isPositional || !placeholder.empty(); }
    /// The words that the placeholder lists: `svg|png|pdf`; none for other placeholders.
    [[nodiscard]] std::vector<std::string> words() const;
    /// The list that the help refers to by "one of `dustbench list scenes`": `scenes`; or empty.
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
