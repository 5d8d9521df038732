// Named, typed, ranged parameters: declared once, from which the command line, suites, `list` and the docs are
// generated.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "methods/contract/choices.h"

namespace dustbench {

enum class ParameterType { integer, real, boolean, choice, cells };

/// One declared parameter. `initial` is the default as text in its canonical form; `minimum` and `maximum` are
/// inclusive, of cells along each edge.
struct DUSTBENCH_API Parameter {
    std::string name;
    ParameterType type = ParameterType::real;
    std::string initial;
    double minimum = 0;
    double maximum = 0;
    std::vector<std::string> choices;
    std::string unit;
    std::string help;
    /// Of a choice among files of data, which takes a file's path as well: where in data they lie, and their extension.
    std::string dataFolder{}, fileExtension{};

    /// What may be given, for people: `integer 0..1000000`, `quicksort|radix|none`.
    [[nodiscard]] std::string allowed() const;
};

/// The parameters that a method (or the harness) declares, in the order of declaration.
class DUSTBENCH_API ParameterSet {
 public:
    ParameterSet& integer(std::string name, std::int64_t initial, std::int64_t minimum, std::int64_t maximum,
                          std::string unit, std::string help);
    ParameterSet& real(std::string name, double initial, double minimum, double maximum, std::string unit,
                       std::string help);
    ParameterSet& boolean(std::string name, bool initial, std::string help);
    /// One of some words, for what has no enumeration.
    ParameterSet& choice(std::string name, std::string initial, std::vector<std::string> choices, std::string help);
    template <typename Enumeration>
    ParameterSet& choice(std::string name, std::type_identity_t<Enumeration> initial,
                         const Choices<Enumeration>& choices, std::string help) {
        return choice(std::move(name), std::string(choices.wordOf(initial)), choices.words(), std::move(help));
    }
    /// One of the names of `data/<folder>/<name><extension>`, or a file by its path: it has a '/' or the extension.
    ParameterSet& dataFile(std::string name, std::string initial, std::string folder, std::string extension,
                           std::vector<std::string> names, std::string help);
    /// The size of a grid, `128x64x64`.
    ParameterSet& cells(std::string name, std::string initial, std::int64_t minimum, std::int64_t maximum,
                        std::string help);

    [[nodiscard]] const std::vector<Parameter>& all() const { return parameters_; }
    [[nodiscard]] const Parameter* find(std::string_view name) const;

 private:
    ParameterSet& add(Parameter parameter);

    std::vector<Parameter> parameters_;
};

/// A value for every parameter of a set, always within its declaration.
class DUSTBENCH_API ParameterValues {
 public:
    ParameterValues() = default;
    /// All defaults.
    explicit ParameterValues(const ParameterSet& declared);

    /// Throws InputError with the parameter, what was got and what is allowed.
    void set(std::string_view name, std::string_view text);

    [[nodiscard]] std::int64_t integer(std::string_view name) const;
    [[nodiscard]] double real(std::string_view name) const;
    [[nodiscard]] bool boolean(std::string_view name) const;
    /// Of a data file too.
    [[nodiscard]] const std::string& choice(std::string_view name) const;
    [[nodiscard]] std::array<int, 3> cells(std::string_view name) const;
    /// What the choice stands for in the table that it is declared with.
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

    ParameterSet declared_;
    std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace dustbench
