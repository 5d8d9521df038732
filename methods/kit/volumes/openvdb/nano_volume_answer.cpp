// Separate from the other files, because NanoVDB's headers are slow to compile as well.
// These macros make NanoVDB read compressed files. NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
// NOLINTEND(cppcoreguidelines-macro-usage)
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/IO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "methods/kit/volumes/openvdb/answer.h"

namespace dustbench::volumes {
namespace {

using Handle = nanovdb::GridHandle<nanovdb::HostBuffer>;

struct NanoChoice {
    const WantedField* wanted;
    Handle handle;
};

/// Numbers per value of this type; 0: a type that is not read.
int componentsOf(nanovdb::GridType type) {
    switch (type) {
        case nanovdb::GridType::Float:
        case nanovdb::GridType::Double:
        case nanovdb::GridType::Fp4:
        case nanovdb::GridType::Fp8:
        case nanovdb::GridType::Fp16:
        case nanovdb::GridType::FpN:
            return 1;
        case nanovdb::GridType::Vec3f:
            return 3;
        default:
            return 0;
    }
}

/// Calls take(grid) with the grid cast to its type.
template <typename Take>
void visit(const Handle& handle, const Take& take) {
    const auto as = [&]<typename Build>(Build) {
        const auto* const grid = handle.template grid<Build>();
        if (!grid) throw Refusal{notWholeOf(".nvdb")};
        take(*grid);
    };
    switch (handle.gridMetaData()->gridType()) {
        case nanovdb::GridType::Float:
            return as(float{});
        case nanovdb::GridType::Double:
            return as(double{});
        case nanovdb::GridType::Fp4:
            return as(nanovdb::Fp4{});
        case nanovdb::GridType::Fp8:
            return as(nanovdb::Fp8{});
        case nanovdb::GridType::Fp16:
            return as(nanovdb::Fp16{});
        case nanovdb::GridType::FpN:
            return as(nanovdb::FpN{});
        case nanovdb::GridType::Vec3f:
            return as(nanovdb::Vec3f{});
        default:
            throw Refusal{notWholeOf(".nvdb")};
    }
}

struct Lattice {
    double spacing = 0;
    nanovdb::Vec3d origin{0};
    nanovdb::CoordBBox box;

    /// Ignores rounding errors.
    bool operator==(const Lattice& other) const {
        return std::abs(other.spacing / spacing - 1) <= 1e-5 && (other.origin - origin).length() <= 1e-5 * spacing;
    }
};

/// Throws Refusal unless the cells are cubes aligned with the world's axes.
template <typename Grid>
Lattice latticeOf(const Grid& grid) {
    Lattice lattice{grid.voxelSize()[0], grid.indexToWorld(nanovdb::Vec3d(0.0)), grid.indexBBox()};
    if (!(lattice.spacing > 0) || !std::isfinite(lattice.spacing)) throw Refusal{"its cells are not cubes"};
    for (int axis = 0; axis < 3; ++axis) {
        nanovdb::Vec3d unit(0.0);
        unit[axis] = 1;
        const nanovdb::Vec3d off = grid.indexToWorld(unit) - lattice.origin - lattice.spacing * unit;
        if (!(off.length() <= 1e-5 * lattice.spacing)) throw Refusal{"its cells are not cubes along the axes"};
    }
    return lattice;
}

/// False for another lattice, including a rotated one.
bool liesOn(const Lattice& lattice, const Handle& handle) {
    bool isThere = false;
    try {
        visit(handle, [&](const auto& grid) { isThere = latticeOf(grid) == lattice; });
    } catch (const Refusal&) {
        return false;
    }
    return isThere;
}

double countOf(const nanovdb::CoordBBox& box) {
    double cells = 1;
    for (int axis = 0; axis < 3; ++axis)
        cells *= std::max(static_cast<double>(box.max()[axis]) - static_cast<double>(box.min()[axis]) + 1, 0.0);
    return cells;
}

/// A level set as fog, as OpenVDB's sdfToFogVolume makes it: 0 at the surface, 1 from the half width of its band on.
float fogOf(float distance, float halfWidth) {
    return distance < 0 ? std::min(-distance / halfWidth, 1.0f) : 0.0f;
}

/// Averages vectors on the lower faces of cells to the centres: half of both faces, or only the lower one if there is
/// no upper one.
template <typename Values>
nanovdb::Vec3f middleOf(const Values& faces, const nanovdb::Coord& cell) {
    nanovdb::Vec3f middle = faces.getValue(cell);
    for (int axis = 0; axis < 3; ++axis) {
        nanovdb::Coord upper = cell;
        if (upper[axis] == std::numeric_limits<int>::max()) continue;
        upper[axis] += 1;
        nanovdb::Vec3f above(0.0f);
        if (faces.probeValue(upper, above)) middle[axis] = (middle[axis] + above[axis]) / 2;
    }
    return middle;
}

/// Inactive voxels count as background, for a density as 0, because NanoVDB's own fog spheres have a different
/// background. Without a leaf, eight cells along x have one value, unless values include part of their neighbours'.
template <typename Grid>
void putValues(const Grid& grid, const nanovdb::CoordBBox& box, bool isDensity) {
    using Value = typename Grid::ValueType;
    using Shown = std::conditional_t<std::is_same_v<Value, nanovdb::Vec3f>, nanovdb::Vec3f, float>;
    const auto values = grid.getAccessor();
    const auto shownAt = [&](const nanovdb::Coord& cell) {
        Value value{};
        [[maybe_unused]] const bool isActive = values.probeValue(cell, value);
        if constexpr (std::is_same_v<Shown, float>) {
            const auto number = static_cast<float>(value);
            if (grid.isLevelSet()) return fogOf(number, static_cast<float>(grid.tree().background()));
            return isActive ? number : isDensity ? 0.0f : static_cast<float>(grid.tree().background());
        } else {
            if (!isActive) return grid.tree().background();
            return grid.isStaggered() ? middleOf(values, cell) : value;
        }
    };
    std::array<Shown, 8> run;
    for (int z = box.min()[2]; z <= box.max()[2]; ++z)
        for (int y = box.min()[1]; y <= box.max()[1]; ++y)
            for (std::int64_t x = box.min()[0]; x <= box.max()[0];) {
                const std::int64_t end = std::min<std::int64_t>(x | 7, box.max()[0]) + 1;
                const auto count = static_cast<std::size_t>(end - x);
                const auto cellAt = [&](std::size_t i) {
                    return nanovdb::Coord(static_cast<int>(x + static_cast<std::int64_t>(i)), y, z);
                };
                run[0] = shownAt(cellAt(0));
                const bool isSame = !grid.isStaggered() && values.probeLeaf(cellAt(0)) == nullptr;
                for (std::size_t i = 1; i < count; ++i) run[i] = isSame ? run[0] : shownAt(cellAt(i));
                put(run.data(), count * sizeof(Shown));
                x = end;
            }
}

/// An optional field must be on the density's lattice; on another one it counts as missing.
std::vector<NanoChoice> choose(const std::string& file, const std::array<WantedField, 3>& wanted,
                               std::vector<std::string>& ignored) {
    std::vector<PresentField> present;
    for (const auto& each : nanovdb::io::readGridMetaData(file))
        present.push_back({each.gridName, componentsOf(each.gridType),
                           "grid " + std::to_string(present.size() + 1) + " of " + nanovdb::toStr(each.gridType)});
    if (present.empty()) throw Refusal{notWholeOf(file)};
    std::vector<NanoChoice> chosen;
    std::vector<std::size_t> places;
    for (const WantedField& each : wanted) {
        std::vector<PresentField> shown = present;
        for (std::size_t i = 0; i < shown.size() && !chosen.empty() && !each.isRequired; ++i) {
            if (std::ranges::find(each.names, shown[i].name) == each.names.end() ||
                shown[i].components != each.components)
                continue;
            Lattice lattice;
            visit(chosen[0].handle, [&](const auto& grid) { lattice = latticeOf(grid); });
            if (!liesOn(lattice, nanovdb::io::readGrid(file, i))) shown[i].components = 0;
        }
        const int at = chosenField<Refusal>(each, shown);
        if (at < 0) continue;
        places.push_back(static_cast<std::size_t>(at));
        chosen.push_back({&each, nanovdb::io::readGrid(file, places.back())});
    }
    ignored = restOf(present, places);
    return chosen;
}

}  // namespace

void answerNanoVolume(const std::string& file, const VolumeFields& fields) {
    const auto wanted = wantedFields(fields);
    std::vector<std::string> ignored;
    const std::vector<NanoChoice> chosen = choose(file, wanted, ignored);
    Lattice lattice;
    visit(chosen[0].handle, [&](const auto& grid) {
        lattice = latticeOf(grid);
        if constexpr (!std::is_same_v<typename std::decay_t<decltype(grid)>::ValueType, nanovdb::Vec3f>)
            if (const auto background = static_cast<double>(grid.tree().background());
                background != 0 && !grid.isLevelSet() && !grid.isFogVolume())
                throw Refusal{"its density continues beyond its grid: the background is " + std::to_string(background) +
                              ", expected 0"};
    });
    const double cells = countOf(lattice.box);
    if (!(cells >= 1)) throw Refusal{"its density is zero everywhere"};
    if (cells > static_cast<double>(maximumCells(fields))) throw Refusal{tooManyCells(fields)};
    for (const NanoChoice& each : chosen)
        if (!liesOn(lattice, each.handle))
            throw Refusal{"its field for the " + std::string(each.wanted->what) +
                          " is on a different grid from its density"};
    VdbMessage message;
    message.spacing = lattice.spacing;
    message.columns = static_cast<std::int32_t>(chosen.size());
    for (int axis = 0; axis < 3; ++axis) {
        message.cells[axis] = lattice.box.max()[axis] - lattice.box.min()[axis] + 1;
        message.origin[axis] = lattice.origin[axis] + (lattice.box.min()[axis] - 0.5) * lattice.spacing;
    }
    putMessage(message, ignored);
    for (const NanoChoice& each : chosen) {
        put(columnOf(*each.wanted));
        visit(each.handle, [&](const auto& grid) { putValues(grid, lattice.box, each.wanted->what == "density"); });
    }
    finish();
}

}  // namespace dustbench::volumes
