// A measurable statement of a paper, and the rule that compares our results with it.
//
// `data/papers/<id>/claims.toml` contains the claims; data/papers/README.md documents every key. A rule consists of a
// quantity, computed from the rows of summary.csv or found by an experiment, and of the range in which the claim is
// true. Each rule has controls: data with a known outcome, which detect a rule that cannot fail.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/contract/choices.h"

namespace dustbench::claims {

enum class Quantity {
    none,      ///< not testable; `missing` gives the reason
    ratio,     ///< of a column between two selections, row by row in the same world
    matched,   ///< a ratio of a column where another column, `match`, is the same on both sides
    share,     ///< the sum of some columns divided by another column
    growth,    ///< of a column from the minimum value of `against` to the maximum
    trend,     ///< rank correlation (Kendall's τ) of a column with `against`: 1 if it always rises, −1 if it falls
    slopes,    ///< of a column over `against`: from the middle load to the maximum, over that from the minimum to the
               ///< middle
    exponent,  ///< k of column = a + b·against^k
    value,     ///< of a column
    finding    ///< an experiment's result, with its own interval
};

inline constexpr Choices<Quantity> quantityWords{{"none", Quantity::none},       {"ratio", Quantity::ratio},
                                                 {"matched", Quantity::matched}, {"share", Quantity::share},
                                                 {"growth", Quantity::growth},   {"trend", Quantity::trend},
                                                 {"slopes", Quantity::slopes},   {"exponent", Quantity::exponent},
                                                 {"value", Quantity::value},     {"finding", Quantity::finding}};

/// The repetitions from which the interval of a quantity is computed.
enum class Chance {
    repetitions,  ///< for times, which vary between repetitions
    seeds,        ///< for quantities that depend on the random cloud, which vary between seeds
    none          ///< for quantities such as bytes, which do not vary and have no interval
};

/// The known verdict of a control.
enum class ControlOutcome { refuted, confirmed };

/// Selects rows by the values of columns: `method` → `billboard`, `p.soft` → `true`.
using Selection = std::vector<std::pair<std::string, std::string>>;

/// Parses `billboard soft=true`: a method, then values of parameters; or values alone. `scene` and `drive` are columns,
/// any other name is a parameter. Messages begin with `what`. Throws InputError.
[[nodiscard]] Selection parseSelection(const std::string& text, const std::string& what);
/// The selection as text.
[[nodiscard]] std::string textOf(const Selection& selection);
/// The values separated by bars: `10|40`.
[[nodiscard]] std::vector<std::string> alternativesIn(const std::string& text);
/// `particles` for the column `p.particles`.
[[nodiscard]] std::string nameOf(const std::string& column);
/// Edge of the finest voxels, world_edge / 2^depth: a condition may be stated along it instead of the depth.
inline constexpr std::string_view voxelEdgeColumn = "p.voxel_edge";
/// Throws InputError if summary.csv has no such column. Parameters, `p.…`, may have any name.
void requireColumn(const std::string& where, const std::string& name);

/// A quantity, the data from which it is computed, and the range in which a claim is true.
struct Rule {
    Quantity quantity = Quantity::none;
    std::string suite;  ///< or, for a finding:
    std::string experiment;
    std::string column;              ///< for a finding: its quantity
    std::string name, unit;          ///< for a finding: its quantity in words, and the unit; may be empty
    std::string per;                 ///< the column to divide by, row by row; empty: none
    std::vector<std::string> parts;  ///< for a share: the columns whose sum is the numerator
    std::string match;               ///< for a matched ratio: the column that is the same
    Selection of, with;              ///< both for a ratio, otherwise only `of`
    std::string against;             ///< the load, for quantities computed from a curve
    Chance over = Chance::repetitions;
    std::string along;  ///< the column along which a condition is stated; empty: the one that separates the cells
    std::optional<double> minimum, maximum;  ///< the range in which the claim is true

    [[nodiscard]] bool isTrueAt(double value) const {
        return (!minimum || value >= *minimum) && (!maximum || value <= *maximum);
    }
    /// `0.9 to 1.1`, `3 or more`.
    [[nodiscard]] std::string expected() const;
    /// A value of the quantity with four digits: bytes as `2.175 MB`; empty for NaN.
    [[nodiscard]] std::string textOf(double value) const;
    /// The quantity in words: `build_ms_median of octree_recursive over that of octree_search`.
    [[nodiscard]] std::string inWords() const;
};

/// Data for which the outcome of a claim's rule is known.
struct ControlRule {
    Rule rule;  ///< the claim's rule with other data
    ControlOutcome gives = ControlOutcome::refuted;
    std::string why;  ///< why this outcome is known
};

struct Claim {
    std::string id;       ///< `R5a`
    std::string text;     ///< the paper's statement in our words
    bool device = false;  ///< the claim depends on the device: the verdict holds for the measured device
    Rule rule;
    std::string reason;  ///< for the range; independent of the results
    std::vector<ControlRule> controls;
    std::string missing;  ///< why it is not testable
    std::string where;    ///< `file:line: `, the beginning of messages
};

/// All claims of a paper, in the order of its file; none if the file does not exist. Throws InputError with file and
/// line.
[[nodiscard]] std::vector<Claim> loadClaims(const std::string& paper);
[[nodiscard]] std::vector<Claim> parseClaims(std::string_view text, const std::string& name);

}  // namespace dustbench::claims
