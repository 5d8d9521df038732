// The points of one file, with columns of numbers, as the file holds them.
//
// Units and frame: the file's own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::volumes {

struct PointColumn {
    std::string name;
    int components = 1;
    std::vector<double> values;  ///< point by point; empty if the column was not asked for
    bool isByte = false;         ///< the file holds 8 bits without a sign
};

struct PointTable {
    std::size_t points = 0;
    std::vector<PointColumn> columns;
    std::optional<double> timeSeconds;
    std::vector<std::string> ignored{};  ///< what the file holds besides its columns: `grid 'density'`

    /// Null if there is none of that name.
    [[nodiscard]] const PointColumn* find(std::string_view name) const {
        const auto found = std::ranges::find(columns, name, &PointColumn::name);
        return found == columns.end() ? nullptr : &*found;
    }
};

/// Which columns are read; of the others only the name is kept.
using WantsColumn = std::function<bool(std::string_view name)>;

/// The column of a `.vtp` or `.vdb` that holds the positions.
inline constexpr std::string_view pointsColumn = "Points";

}  // namespace dustbench::volumes
