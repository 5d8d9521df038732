// The shares of lattice cells that an interval covers along one axis.
//
// Units: cells. Threads: pure.
#pragma once

#include <array>
#include <cmath>

namespace dustbench::grid_fluid {

/// An interval of at most one cell touches at most two; their shares sum to 1.
struct Overlaps {
    Overlaps(double from, double to) {
        // Shares that are rounding errors would create tiles.
        constexpr double least = 1e-6;
        first = static_cast<int>(std::floor(from));
        const double border = first + 1.0;
        const double length = to - from, before = length > 0 ? std::fmin((border - from) / length, 1.0) : 1.0;
        if (before < least) {
            ++first;
        } else if (before < 1 - least) {
            shares = {before, 1 - before};
            count = 2;
        }
    }

    int first;
    int count = 1;
    std::array<double, 2> shares{1, 0};
};

}  // namespace dustbench::grid_fluid
