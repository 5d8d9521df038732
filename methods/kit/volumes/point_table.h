// The points of one file, with columns of numbers, as stored in the file.
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
    bool isByte = false;         ///< stored as unsigned 8-bit numbers
};

struct PointTable {
    std::size_t points = 0;
    std::vector<PointColumn> columns;
    std::optional<double> timeSeconds;
    std::vector<std::string> ignored{};  ///< other contents of the file: `grid 'density'`

    /// Null if there is no column of that name.
    [[nodiscard]] const PointColumn* find(std::string_view name) const {
        const auto found = std::ranges::find(columns, name, &PointColumn::name);
        return found == columns.end() ? nullptr : &*found;
    }
};

/// Selects the columns to read; of the others only the name is kept.
using WantsColumn = std::function<bool(std::string_view name)>;

/// The column with the positions of a `.vtp` or `.vdb`.
inline constexpr std::string_view pointsColumn = "Points";

}  // namespace dustbench::volumes
