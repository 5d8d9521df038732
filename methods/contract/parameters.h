// Parameters with a name, a type and a range. One declaration generates the command line, suites, `list` and the
// documentation.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "methods/contract/choices.h"

namespace dustbench {

enum class ParameterType { integer, real, boolean, choice, cells, changes };

/// A change during a run: in every frame k ≥ 0 with k·step ≥ `seconds` (to a thousandth of a step), `name` has `value`.
/// The method defines what names and values mean.
struct Change {
    double seconds;  ///< since the start of frame 0; 0 or more
    std::string name, value;

    bool operator==(const Change&) const = default;
};

/// One declared parameter. `initial` is the default as text in its canonical form; `minimum` and `maximum` are
/// inclusive; for a grid they limit the cells along each edge.
struct DUSTBENCH_API Parameter {
    std::string name;
    ParameterType type = ParameterType::real;
    std::string initial;
    double minimum = 0;
    double maximum = 0;
    std::vector<std::string> choices;
    std::string unit;
    std::string help;
    /// For a data file: its folder in the data, and its extension, or several: `.vdb|.vti`.
    std::string dataFolder{}, fileExtension{};

    /// The allowed values as text: `integer 0..1000000`, `quicksort|radix|none`.
    [[nodiscard]] std::string allowed() const;
};

/// Other defaults, which apply while the choice `parameter` has the value `word`.
struct Preset {
    std::string parameter, word;
    std::vector<std::pair<std::string, std::string>> defaults;  ///< name and canonical text
};

/// The parameters that a method (or the harness) declares, in the order of declaration.
class DUSTBENCH_API ParameterSet {
 public:
    ParameterSet& integer(std::string name, std::int64_t initial, std::int64_t minimum, std::int64_t maximum,
                          std::string unit, std::string help);
    ParameterSet& real(std::string name, double initial, double minimum, double maximum, std::string unit,
                       std::string help);
    ParameterSet& boolean(std::string name, bool initial, std::string help);
    /// One of several words, without an enumeration; no words: any text.
    ParameterSet& choice(std::string name, std::string initial, std::vector<std::string> choices, std::string help);
    template <typename Enumeration>
    ParameterSet& choice(std::string name, std::type_identity_t<Enumeration> initial,
                         const Choices<Enumeration>& choices, std::string help) {
        return choice(std::move(name), std::string(choices.wordOf(initial)), choices.words(), std::move(help));
    }
    /// A name, which stands for `data/<folder>/<name><extension>`, or a path, recognised by a '/' or its extension.
    ParameterSet& dataFile(std::string name, std::string initial, std::string folder, std::string extension,
                           std::vector<std::string> names, std::string help);
    /// The number of cells of a grid, `128x64x64`.
    ParameterSet& cells(std::string name, std::string initial, std::int64_t minimum, std::int64_t maximum,
                        std::string help);
    /// Changes during the run, `2.5s:NAME=VALUE;4s:…`; none by default. The command line's `--at` sets it.
    ParameterSet& changes(std::string name, std::string help);

    /// Makes `word` of the choice `name` a preset, which changes the defaults of parameters declared earlier. A value
    /// that is set explicitly wins. The choice's help lists the defaults.
    ParameterSet& preset(std::string_view name, std::string_view word,
                         const std::vector<std::pair<std::string, std::string>>& defaults);

    [[nodiscard]] const std::vector<Parameter>& all() const { return parameters_; }
    [[nodiscard]] const std::vector<Preset>& presets() const { return presets_; }
    [[nodiscard]] const Parameter* find(std::string_view name) const;

 private:
    ParameterSet& add(Parameter parameter);

    std::vector<Parameter> parameters_;
    std::vector<Preset> presets_;
};

/// A value for every parameter of a set, always within its declaration.
class DUSTBENCH_API ParameterValues {
 public:
    ParameterValues() = default;
    /// The defaults.
    explicit ParameterValues(const ParameterSet& declared);

    /// Throws InputError with the parameter, the value received and the values allowed. The order of calls for
    /// different parameters does not matter.
    void set(std::string_view name, std::string_view text);

    [[nodiscard]] std::int64_t integer(std::string_view name) const;
    [[nodiscard]] double real(std::string_view name) const;
    [[nodiscard]] bool boolean(std::string_view name) const;
    /// Also for data files.
    [[nodiscard]] const std::string& choice(std::string_view name) const;
    [[nodiscard]] std::array<int, 3> cells(std::string_view name) const;
    /// Sorted by time; changes at the same time keep the given order.
    [[nodiscard]] std::vector<Change> changes(std::string_view name) const;
    /// The value that the chosen word has in the table it was declared with.
    template <typename Enumeration>
    [[nodiscard]] Enumeration choice(std::string_view name, const Choices<Enumeration>& choices) const {
        return choices.valueOf(choiceOf(name, choices.words()));
    }

    /// Canonical text of every value, sorted by name: `0.50` and `.5` are both `0.5`.
    [[nodiscard]] const std::map<std::string, std::string, std::less<>>& canonical() const { return values_; }
    [[nodiscard]] const ParameterSet& declared() const { return declared_; }

 private:
    [[nodiscard]] const std::string& value(std::string_view name, ParameterType type) const;
    [[nodiscard]] const std::string& choiceOf(std::string_view name, const std::vector<std::string>& words) const;
    void applyPresets();

    ParameterSet declared_;
    std::map<std::string, std::string, std::less<>> values_;
    std::set<std::string, std::less<>> given_;  ///< names that were set
};

}  // namespace dustbench
