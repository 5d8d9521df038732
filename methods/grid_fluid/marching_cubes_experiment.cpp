#include "methods/grid_fluid/marching_cubes_experiment.h"

#include <algorithm>
#include <array>
#include <set>

namespace dustbench::grid_fluid::marching_cubes {
namespace {

/// The image of each corner of the cube; a corner's bits are its x, y and z.
using CornerMap = std::array<int, 8>;

/// The 48 symmetries of the cube; 24 of them are rotations.
std::vector<CornerMap> symmetries(bool withMirrors) {
    std::vector<CornerMap> maps;
    std::array<int, 3> axes{0, 1, 2};
    do {
        int exchanges = 0;
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = a + 1; b < 3; ++b) exchanges += axes[a] > axes[b] ? 1 : 0;
        for (int flips = 0; flips < 8; ++flips) {
            const int flipped = (flips & 1) + (flips >> 1 & 1) + (flips >> 2);
            if (!withMirrors && (exchanges + flipped) % 2 == 1) continue;
            CornerMap& map = maps.emplace_back();
            for (int corner = 0; corner < 8; ++corner) {
                int moved = 0;
                for (std::size_t a = 0; a < 3; ++a) moved |= (corner >> a & 1) << axes[a];
                map[static_cast<std::size_t>(corner)] = moved ^ flips;
            }
        }
    } while (std::ranges::next_permutation(axes).found);
    return maps;
}

int moved(int within, const CornerMap& map) {
    int result = 0;
    for (std::size_t corner = 0; corner < 8; ++corner)
        if ((within >> corner & 1) != 0) result |= 1 << map[corner];
    return result;
}

}  // namespace

int classesOf(bool withMirrors, bool withExchange) {
    const std::vector<CornerMap> maps = symmetries(withMirrors);
    std::set<int> first;  // of each class
    for (int within = 0; within < 256; ++within) {
        int least = within;
        for (const CornerMap& map : maps) {
            const int other = moved(within, map);
            least = std::min(least, other);
            if (withExchange) least = std::min(least, 255 ^ other);
        }
        first.insert(least);
    }
    return static_cast<int>(first.size());
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Counts the ways in which a surface can cross a cell.";
    info.source = "Senger2009";
    info.run = [](ExperimentContext&) {
        const auto counted = [](const char* quantity, bool withMirrors, bool withExchange) {
            const auto classes = static_cast<double>(classesOf(withMirrors, withExchange));
            return Finding{quantity, classes, classes, classes, 256};
        };
        return std::vector<Finding>{counted("turns_and_exchange", false, true), counted("turns", false, false),
                                    counted("turns_mirrors_and_exchange", true, true)};
    };
    return info;
}

}  // namespace dustbench::grid_fluid::marching_cubes
