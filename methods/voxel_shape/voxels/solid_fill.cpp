#include "methods/voxel_shape/voxels/solid_fill.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::array<glm::ivec3, 6> steps{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// Breadth-first search from `front` over all cells that `take(cell, from)` accepts.
template <typename Take>
void spread(const Lattice& lattice, std::vector<std::uint32_t> front, const Take& take) {
    std::vector<std::uint32_t> next;
    while (!front.empty()) {
        next.clear();
        for (const std::uint32_t from : front) {
            const glm::ivec3 cell = lattice.cell(from);
            for (const glm::ivec3& step : steps) {
                if (!lattice.contains(cell + step)) continue;
                const std::uint32_t to = lattice.index(cell + step);
                if (take(to, from)) next.push_back(to);
            }
        }
        std::swap(front, next);
    }
}

/// 1 for each cell that is reachable from outside the lattice through unmarked cells. Sweeps row by row, forwards and
/// backwards, each cell from its neighbours, until a sweep finds no new cell. Few sweeps suffice, since few shapes have
/// winding cavities.
class OutsideSweeps {
 public:
    explicit OutsideSweeps(const MarkedVoxels& surface)
        : counts_(surface.lattice.counts),
          marked_(surface.marked.data()),
          outside_(static_cast<std::size_t>(counts_.x), 1),
          reached_(surface.lattice.size(), 0),
          found_(static_cast<std::size_t>(counts_.y) * static_cast<std::size_t>(counts_.z), 0) {
        while (sweep(false) && sweep(true)) {
        }
    }
    [[nodiscard]] const std::vector<std::uint8_t>& reached() const { return reached_; }

 private:
    /// Returns whether the sweep reached a new cell.
    bool sweep(bool back) {
        bool any = false;
        for (int k = 0; k < counts_.z; ++k)
            for (int j = 0; j < counts_.y; ++j)
                any |= back ? visitRow(counts_.y - 1 - j, counts_.z - 1 - k) : visitRow(j, k);
        return any;
    }
    bool visitRow(int y, int z) {
        const auto nx = static_cast<std::size_t>(counts_.x);
        const std::size_t row =
            static_cast<std::size_t>(z) * static_cast<std::size_t>(counts_.y) + static_cast<std::size_t>(y);
        const std::uint8_t* const marked = marked_ + row * nx;
        std::uint8_t* const own = reached_.data() + row * nx;
        const auto reachFrom = [&](bool isInside, std::ptrdiff_t rows) {
            const std::uint8_t* const neighbour =
                isInside ? own + rows * static_cast<std::ptrdiff_t>(nx) : outside_.data();
#pragma GCC ivdep
            for (std::size_t i = 0; i < nx; ++i) own[i] |= static_cast<std::uint8_t>(neighbour[i] & (marked[i] ^ 1));
        };
        reachFrom(y > 0, -1);
        reachFrom(y + 1 < counts_.y, 1);
        reachFrom(z > 0, -std::ptrdiff_t{counts_.y});
        reachFrom(z + 1 < counts_.z, counts_.y);
        const auto goAlong = [&](std::size_t i, std::uint8_t& reached) {
            reached = static_cast<std::uint8_t>((reached | own[i]) & (marked[i] ^ 1));
            own[i] = reached;
        };
        std::uint8_t reached = 1;
        for (std::size_t i = 0; i < nx; ++i) goAlong(i, reached);
        reached = 1;
        std::size_t found = 0;
        for (std::size_t i = nx; i-- > 0;) {
            goAlong(i, reached);
            found += reached;
        }
        return std::exchange(found_[row], found) != found;
    }

    glm::ivec3 counts_;
    const std::uint8_t* marked_;
    std::vector<std::uint8_t> outside_;  ///< a row outside the lattice
    std::vector<std::uint8_t> reached_;
    std::vector<std::size_t> found_;  ///< cells reached, by row
};

}  // namespace

bool markInside(MarkedVoxels& surface) {
    const OutsideSweeps sweeps(surface);
    bool any = false;
    for (std::size_t i = 0; i < surface.marked.size(); ++i) {
        const auto inside = static_cast<std::uint8_t>(sweeps.reached()[i] ^ 1);
        any |= inside != surface.marked[i];
        surface.marked[i] = inside;
    }
    return any;
}

bool fillInside(MarkedVoxels& surface) {
    std::vector<std::uint8_t> toColour = surface.marked;
    if (!markInside(surface)) return false;
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < toColour.size(); ++i) {
        if (toColour[i]) front.push_back(i);
        toColour[i] ^= surface.marked[i];
    }
    spread(surface.lattice, std::move(front), [&](std::uint32_t cell, std::uint32_t from) {
        if (!toColour[cell]) return false;
        toColour[cell] = 0;
        surface.colours[cell] = surface.colours[from];
        return true;
    });
    return true;
}

void fillSolid(MarkedVoxels& surface, const scene::Mesh& mesh) {
    if (fillInside(surface)) return;
    if (const std::size_t open = meshes::openEdges(mesh); open > 0)
        throw InputError("solid voxels: the mesh is open (" + std::to_string(open) +
                         " open edges) and encloses nothing at this resolution; allowed: a closed "
                         "mesh, holes narrower than a voxel, or fill = \"surface\"");
}

}  // namespace dustbench::voxel_shape
