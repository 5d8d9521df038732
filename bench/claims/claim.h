// A measurable statement of a paper, and the rule that compares our results with it.
//
// `data/papers/<id>/claims.toml` contains the claims; data/papers/README.md documents every key. A rule is a quantity
// computed from the rows of summary.csv, or a finding of an experiment, and the range in which the claim is true.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dustbench::bench {

enum class Quantity {
    none,      ///< not testable; `missing` gives the reason
    ratio,     ///< of a column between two selections, row by row in the same world
    share,     ///< the sum of some columns divided by another column
    growth,    ///< of a column from the minimum value of `against` to the maximum
    exponent,  ///< k of column = a + b·against^k
    value,     ///< of a column
    finding    ///< an experiment's result, with its own interval
};

/// The rows with these cells: `method` → `billboard`, `p.soft` → `true`.
using Selection = std::vector<std::pair<std::string, std::string>>;

/// Parses `billboard soft=true`: a method, then cells of parameters; or cells alone. Messages begin with `what`.
/// Throws InputError.
[[nodiscard]] Selection parseSelection(const std::string& text, const std::string& what);
/// Throws InputError if summary.csv has no such column. Parameters, `p.…`, may have any name.
void requireColumn(const std::string& where, const std::string& name);

struct Claim {
    std::string id;     ///< `R5a`
    std::string text;   ///< what the paper says, in our words
    std::string suite;  ///< or, for a finding:
    std::string experiment;
    Quantity quantity = Quantity::none;
    std::string column;              ///< for a finding: its quantity
    std::string per;                 ///< the column to divide by, row by row; empty: none
    std::vector<std::string> parts;  ///< for a share: the columns whose sum is the numerator
    Selection of, with;              ///< both for a ratio, otherwise only `of`
    std::string against;
    /// True: the column does not depend on the machine (bytes, counts, metrics), so the spread over the rows
    /// replaces the interval over repetitions.
    bool exact = false;
    std::optional<double> minimum, maximum;  ///< the range in which the claim is true
    std::string missing;
    std::string where;  ///< `file:line: `; messages begin with it

    /// `below 1`, `0.9 to 1.1`.
    [[nodiscard]] std::string expected() const;
};

/// All claims of a paper, in the order of its file; none if the file does not exist. Throws InputError with file and
/// line.
[[nodiscard]] std::vector<Claim> loadClaims(const std::string& paper);
[[nodiscard]] std::vector<Claim> parseClaims(std::string_view text, const std::string& name);

}  // namespace dustbench::bench
