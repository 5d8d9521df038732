// What a paper says that can be measured, and the rule by which our results are held against it.
//
// `data/papers/<id>/claims.toml` has them; data/papers/README.md names every key. A rule is a quantity of the rows of
// summary.csv, or what an experiment found, and the range of values in which the claim is true.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dustbench::bench {

enum class Quantity {
    none,      ///< cannot be tested, and `missing` says why
    ratio,     ///< of one selection's column over another's, row by row in the same world
    share,     ///< of the sum of some columns in another column
    growth,    ///< of a column from the minimum value of `against` to the maximum
    exponent,  ///< k of column = a + b·against^k
    value,     ///< of a column
    finding    ///< of an experiment, with its own interval
};

/// Rows that have these cells: `method` → `billboard`, `p.soft` → `true`.
using Selection = std::vector<std::pair<std::string, std::string>>;

/// Of `billboard soft=true`: a method, then cells of parameters; or cells alone. `what` begins messages. Throws
/// InputError.
[[nodiscard]] Selection parseSelection(const std::string& text, const std::string& what);
/// Throws InputError where summary.csv has no such column; parameters, `p.…`, may have any name.
void requireColumn(const std::string& where, const std::string& name);

struct Claim {
    std::string id;     ///< `R5a`
    std::string text;   ///< what the paper says, in our words
    std::string suite;  ///< or, of a finding:
    std::string experiment;
    Quantity quantity = Quantity::none;
    std::string column;              ///< of a finding: its quantity
    std::string per;                 ///< a column by which it is divided, row by row; empty: it is not
    std::vector<std::string> parts;  ///< of a share: columns whose sum is the numerator
    Selection of, with;              ///< of a ratio both, else `of` alone
    std::string against;
    /// True: the column does not depend on the machine (bytes, counts, metrics), so the spread over the rows takes the
    /// place of an interval over repetitions.
    bool exact = false;
    std::optional<double> minimum, maximum;  ///< where the claim is true
    std::string missing;
    std::string where;  ///< `file:line: `, for messages

    /// `below 1`, `0.9 to 1.1`.
    [[nodiscard]] std::string expected() const;
};

/// All claims of a paper, in the order of its file; none where it has no such file. Throws InputError with file and
/// line.
[[nodiscard]] std::vector<Claim> loadClaims(const std::string& paper);
[[nodiscard]] std::vector<Claim> parseClaims(std::string_view text, const std::string& name);

}  // namespace dustbench::bench
