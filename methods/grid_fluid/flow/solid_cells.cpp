#include "methods/grid_fluid/flow/solid_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numeric>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

std::uint8_t beyond(Side side) {
    return side == Side::open ? 2 : 0;
}

constexpr std::size_t solidRows = 64;

/// The six neighbours of a cell.
std::array<std::ptrdiff_t, 6> around(const CellLayout& layout) {
    const auto row = static_cast<std::ptrdiff_t>(layout.row), slab = static_cast<std::ptrdiff_t>(layout.slab);
    return {-1, 1, -row, row, -slab, slab};
}

/// Tests one vector of bytes at a time.
bool anySolid(std::span<const std::uint8_t> row) {
    std::uint8_t any = 0;
    for (const std::uint8_t body : row) any |= body;
    return any != 0;
}

/// The bit of a quantity that moves: bit `lane` for a velocity, that of the centre for all others.
Moving bitOf(std::size_t lane) {
    return static_cast<Moving>(1u << std::min<std::size_t>(lane, 3));
}

}  // namespace

void check(const SolidMask& mask, const CellLayout& layout) {
    const std::size_t count = layout.rows() * static_cast<std::size_t>(layout.nx);
    if (!mask.body.empty() && mask.body.size() != count)
        throw InputError("solids: got " + std::to_string(mask.body.size()) +
                         " cells, allowed: " + std::to_string(count) + ", as many as the grid has");
    if (!mask.body.empty() && std::find(mask.body.begin(), mask.body.end(), 0) == mask.body.end())
        throw InputError("solids: the whole box is solid, expected at least one cell of fluid");
    for (std::size_t n = 0; n < mask.motions.size(); ++n) {
        const BodyMotion& motion = mask.motions[n];
        const glm::vec3 all = motion.velocity + motion.turnPerCell + motion.centreCells;
        if (!std::isfinite(all.x + all.y + all.z))
            throw InputError("solids: got a motion of solid " + std::to_string(n + 1) +
                             " that is not finite, allowed: metres per second");
        if (motion.byCell && mask.velocities.size() != count)
            throw InputError("solids: got the velocities of " + std::to_string(mask.velocities.size()) +
                             " cells for solid " + std::to_string(n + 1) +
                             ", which deforms, allowed: " + std::to_string(count) + ", as many as the grid has");
    }
    for (std::size_t cell = 0; cell < mask.velocities.size() && !mask.body.empty(); ++cell) {
        const glm::vec3& velocity = mask.velocities[cell];
        if (mask.body[cell] != 0 && !std::isfinite(velocity.x + velocity.y + velocity.z))
            throw InputError("solids: got a velocity of cell " + std::to_string(cell) +
                             " that is not finite, allowed: metres per second");
    }
}

void conductEverywhere(const CellLayout& layout, const Sides& sides, std::span<std::uint8_t> conductance) {
    std::fill(conductance.begin(), conductance.end(), std::uint8_t{0});
    const auto fill = [&](int i0, int i1, int j0, int j1, int k0, int k1, std::uint8_t value) {
        for (int k = k0; k < k1; ++k)
            for (int j = j0; j < j1; ++j)
                std::memset(conductance.data() + layout.at(i0, j, k), value, static_cast<std::size_t>(i1 - i0));
    };
    const int nx = layout.nx, ny = layout.ny, nz = layout.nz;
    fill(0, nx, 0, ny, 0, nz, 1);
    fill(-1, 0, 0, ny, 0, nz, beyond(sides[0]));
    fill(nx, nx + 1, 0, ny, 0, nz, beyond(sides[1]));
    fill(0, nx, -1, 0, 0, nz, beyond(sides[2]));
    fill(0, nx, ny, ny + 1, 0, nz, beyond(sides[3]));
    fill(0, nx, 0, ny, -1, 0, beyond(sides[4]));
    fill(0, nx, 0, ny, nz, nz + 1, beyond(sides[5]));
}

SolidCells::SolidCells(const CellLayout& layout, const Sides& sides, MemoryAccount& account)
    : layout_(layout), conductance_(account), moving_(account) {
    // Kernels read sixteen bytes at once.
    conductance_.resize(layout.padded() + 16);
    moving_.resize(layout.padded() + 16);
    conductEverywhere(layout, sides, std::span(conductance_).first(layout.padded()));
    rowHasSolid_.resize(layout.rows());
    rimOfSlab_.resize(static_cast<std::size_t>(layout.nz));
}

SolidCells::Change SolidCells::set(const SolidMask& mask, CellField& cells) {
    check(mask, layout_);
    Change change;
    change.coveredDensity = cover(mask, cells);
    if (!mask.body.empty()) change.maximumSpeeds = setFaces(mask, cells);
    findMoving();
    findRim(cells);
    return change;
}

double SolidCells::cover(const SolidMask& mask, CellField& cells) {
    const auto width = static_cast<std::size_t>(layout_.nx);
    std::vector<float> covered(layout_.rows());
    parallel::forEachBlock(layout_.rows(), solidRows, [&](std::size_t first, std::size_t rows) {
        for (std::size_t r = first; r < first + rows; ++r) {
            const std::size_t at = layout_.at(0, layout_.rowJ(r), layout_.rowK(r));
            std::uint8_t* conductance = conductance_.data() + at;
            const auto body = mask.body.empty() ? mask.body : mask.body.subspan(r * width, width);
            const bool hasSolid = anySolid(body);  // most rows of most masks have none
            rowHasSolid_[r] = hasSolid ? 1 : 0;
            if (!hasSolid) {
                std::memset(conductance, 1, width);
                continue;
            }
            for (std::size_t i = 0; i < width; ++i) conductance[i] = body[i] == 0 ? 1 : 0;
            for (std::size_t i = 0; i < width; ++i) {
                if (body[i] == 0) continue;
                float* record = cells.cell(at + i);
                covered[r] += record[density];
                record[density] = record[temperature] = record[reaction] = 0;
            }
        }
    });
    return std::accumulate(covered.begin(), covered.end(), 0.0);
}

/// Each face between two cells belongs to the solid ahead of it, otherwise to that behind it, including the far sides.
/// Returns the maximum speed along each axis.
glm::vec3 SolidCells::setFaces(const SolidMask& mask, CellField& cells) const {
    const glm::ivec3 size(layout_.nx, layout_.ny, layout_.nz);
    const auto indexOf = [&](glm::ivec3 cell) {
        return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(size.y) +
                static_cast<std::size_t>(cell.y)) *
                   static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(cell.x);
    };
    const auto bodyOf = [&](glm::ivec3 cell) { return mask.body[indexOf(cell)]; };
    // A rigid body's speed along an axis is constant along that axis, so the cell's centre can be used for its face. A
    // deforming solid has the speeds of its surface in the adjacent cells.
    const auto speedOf = [&](std::uint8_t body, glm::ivec3 cell, int axis) {
        return mask.velocityOf(body, indexOf(cell), cell)[axis];
    };
    glm::vec3 maximum(0);
    std::mutex mutex;
    for (int axis = 0; axis < 3; ++axis) {
        const auto step = std::array<std::size_t, 3>{1, layout_.row, layout_.slab}[static_cast<std::size_t>(axis)];
        const auto hasFacesOfSolids = [&](glm::ivec3 row) {
            if (!isAllFluid(row.y, row.z)) return true;
            if (axis == 0 || row[axis] == 0) return false;
            row[axis] -= 1;
            return !isAllFluid(row.y, row.z);
        };
        parallel::forEachBlock(layout_.rows(), solidRows, [&](std::size_t first, std::size_t rows) {
            float ofBlock = 0;
            const auto setFace = [&](std::size_t at, float speed) {
                cells.cell(at)[axis] = speed;
                ofBlock = std::max(ofBlock, std::fabs(speed));
            };
            for (std::size_t r = first; r < first + rows; ++r) {
                glm::ivec3 cell(0, layout_.rowJ(r), layout_.rowK(r));
                if (!hasFacesOfSolids(cell)) continue;
                for (; cell.x < size.x; ++cell.x) {
                    const std::uint8_t own = bodyOf(cell);
                    const std::size_t at = layout_.at(cell.x, cell.y, cell.z);
                    glm::ivec3 before = cell;
                    before[axis] -= 1;
                    const std::uint8_t other = before[axis] < 0 ? 0 : bodyOf(before);
                    if (own != 0)
                        setFace(at, speedOf(own, cell, axis));
                    else if (other != 0)
                        setFace(at, speedOf(other, before, axis));
                    if (own != 0 && cell[axis] == size[axis] - 1) setFace(at + step, speedOf(own, cell, axis));
                }
            }
            const std::scoped_lock lock(mutex);
            maximum[axis] = std::max(maximum[axis], ofBlock);
        });
    }
    return maximum;
}

void SolidCells::findMoving() {
    const std::array<std::size_t, 3> steps{1, layout_.row, layout_.slab};
    parallel::forEachBlock(layout_.rows(), solidRows, [&](std::size_t first, std::size_t rows) {
        for (std::size_t r = first; r < first + rows; ++r) {
            const int j = layout_.rowJ(r), k = layout_.rowK(r);
            const std::size_t at = layout_.at(0, j, k);
            const std::uint8_t* own = conductance_.data() + at;
            Moving* moving = moving_.data() + at;
            if (isAllFluid(j, k) && isAllFluid(j - 1, k) && isAllFluid(j, k - 1)) {
                std::memset(moving, allMoves, static_cast<std::size_t>(layout_.nx));
                moving[0] = allMoves & ~bitOf(0);  // the face is on the box's side
                continue;
            }
            const std::array<const std::uint8_t*, 3> before{own - steps[0], own - steps[1], own - steps[2]};
            const auto isFluid = [](std::uint8_t conductance, Moving bit) {
                return conductance == 1 ? bit : Moving{0};
            };
            for (int i = 0; i < layout_.nx; ++i)
                moving[i] = isFluid(own[i], static_cast<Moving>(8 | isFluid(before[0][i], 1) |
                                                                isFluid(before[1][i], 2) | isFluid(before[2][i], 4)));
        }
    });
}

void SolidCells::findRim(const CellField& cells) {
    const auto neighbours = around(layout_);
    const auto row = static_cast<std::ptrdiff_t>(layout_.row), slab = static_cast<std::ptrdiff_t>(layout_.slab);
    const std::array<std::ptrdiff_t, 3> steps{1, row, slab};
    parallel::forEachBlock(static_cast<std::size_t>(layout_.nz), 1, [&](std::size_t k, std::size_t) {
        auto& rim = rimOfSlab_[k];
        rim.clear();
        for (int j = 0; j < layout_.ny; ++j) {
            const std::size_t first = layout_.at(0, j, static_cast<int>(k));
            if (isAllFluid(j, static_cast<int>(k))) continue;
            const std::uint8_t* own = conductance_.data() + first;
            for (int i = 0; i < layout_.nx; ++i) {
                if (own[i] == 1) continue;
                const std::size_t at = first + static_cast<std::size_t>(i);
                const auto add = [&](std::size_t lane) {
                    const bool isNeighbour = std::ranges::any_of(neighbours, [&](std::ptrdiff_t to) {
                        return (moving_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + to)] &
                                bitOf(lane)) != 0;
                    });
                    if (isNeighbour)
                        rim.push_back({static_cast<std::uint32_t>(at), static_cast<std::uint8_t>(lane),
                                       lane < 3 ? cells.cell(at)[lane] : 0});
                };
                add(density);
                for (std::size_t axis = 0; axis < 3; ++axis)
                    if ((own + i)[-steps[axis]] != 1) add(axis);  // otherwise it is the surface itself
            }
        }
    });
    rim_.clear();
    for (const auto& ofSlab : rimOfSlab_) rim_.insert(rim_.end(), ofSlab.begin(), ofSlab.end());
}

void SolidCells::extendInto(CellField& cells, bool slip) const {
    const auto neighbours = around(layout_);
    parallel::forEachBlock(rim_.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const auto [at, lane, solid] = rim_[r];
            if (lane < 3 && !slip) continue;
            float* own = cells.cell(at) + lane;
            const std::size_t quantities = lane < 3 ? 1 : lanes - density;
            std::array<float, lanes> sum{};
            float found = 0;
            for (const std::ptrdiff_t to : neighbours) {
                if ((moving_[static_cast<std::size_t>(at + to)] & bitOf(lane)) == 0) continue;
                const float* other = own + to * static_cast<std::ptrdiff_t>(lanes);
                for (std::size_t q = 0; q < quantities; ++q) sum[q] += other[q];
                found += 1;
            }
            for (std::size_t q = 0; q < quantities; ++q) own[q] = sum[q] / found;
        }
    });
}

void SolidCells::restore(CellField& cells) const {
    for (const auto& [at, lane, solid] : rim_) {
        float* record = cells.cell(at);
        if (lane < 3)
            record[lane] = solid;
        else
            record[density] = record[temperature] = record[reaction] = 0;
    }
}

}  // namespace dustbench::grid_fluid::flow
