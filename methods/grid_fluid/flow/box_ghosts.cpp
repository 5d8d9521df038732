#include "methods/grid_fluid/flow/box_ghosts.h"

#include <array>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// A side across an axis, `high` if it is the far one.
struct BoxSide {
    std::size_t axis;
    bool high;
    Side side;
};

/// `inner` is the outermost cell, `next` the one before it.
void fillGhost(float* ghost, const float* inner, const float* next, const BoxSide& at, const GhostRule& rule) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const bool isVelocity = lane < 3;
        if (lane == at.axis) {
            if (at.high) continue;  // the face on the side
            ghost[lane] = at.side == Side::inflow ? rule.windMetresPerSecond[static_cast<int>(lane)]
                          : at.side == Side::open ? inner[lane]
                                                  : -next[lane];
        } else if (at.side == Side::inflow) {
            ghost[lane] = isVelocity ? rule.windMetresPerSecond[static_cast<int>(lane)] : 0;
        } else if (at.side == Side::open) {
            ghost[lane] = isVelocity ? inner[lane] : 0;
        } else {
            ghost[lane] = isVelocity && rule.noSlip ? -inner[lane] : inner[lane];
        }
    }
}

/// A line of faces on a side, `stride` floats from one to the next; `inwards` leads from a face to the next one within.
void setFaces(float* face, std::ptrdiff_t inwards, std::size_t stride, int count, Side side, float wind) {
    float* const end = face + static_cast<std::size_t>(count) * stride;
    if (side == Side::open)
        for (; face != end; face += stride) *face = face[inwards];
    else
        for (const float speed = side == Side::inflow ? wind : 0; face != end; face += stride) *face = speed;
}

}  // namespace

void setSideFaces(CellField& cells, const CellLayout& layout, const GhostRule& rule) {
    const glm::ivec3 size(layout.nx, layout.ny, layout.nz);
    const std::array<std::size_t, 3> steps{lanes, layout.row * lanes, layout.slab * lanes};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            const int a = static_cast<int>(axis), b = a == 0 ? 1 : 0, c = 3 - a - b;  // along memory in the inner loop
            const auto ahead = static_cast<std::ptrdiff_t>(steps[axis]);
            parallel::forEachBlock(static_cast<std::size_t>(size[c]), 16, [&](std::size_t first, std::size_t count) {
                glm::ivec3 face(0);
                face[a] = high ? size[a] : 0;
                for (face[c] = static_cast<int>(first); face[c] < static_cast<int>(first + count); ++face[c])
                    setFaces(cells.cell(layout.at(face.x, face.y, face.z)) + axis, high ? -ahead : ahead,
                             steps[static_cast<std::size_t>(b)], size[b], rule.sides[2 * axis + (high ? 1 : 0)],
                             rule.windMetresPerSecond[a]);
            });
        }
}

void fillGhosts(CellField& cells, const CellLayout& layout, const GhostRule& rule) {
    const int nx = layout.nx, ny = layout.ny, nz = layout.nz;
    const auto fillRow = [&](glm::ivec2 to, glm::ivec2 from, glm::ivec2 before, const BoxSide& side) {
        float* ghost = cells.cell(layout.at(-1, to.x, to.y));
        const float *inner = cells.cell(layout.at(-1, from.x, from.y)),
                    *next = cells.cell(layout.at(-1, before.x, before.y));
        for (int i = 0; i < nx + 2; ++i, ghost += lanes, inner += lanes, next += lanes)
            fillGhost(ghost, inner, next, side, rule);
    };
    // Faces on a far side beyond the box's edges equal those of its outermost cells.
    const auto extendFace = [&](glm::ivec3 to, glm::ivec3 from, std::size_t lane) {
        cells.cell(layout.at(to.x, to.y, to.z))[lane] = cells.cell(layout.at(from.x, from.y, from.z))[lane];
    };
    // Along x, then y, then z, so that edges and corners are filled from ghosts.
    parallel::forEachBlock(static_cast<std::size_t>(nz), 4, [&](std::size_t first, std::size_t count) {
        for (std::size_t slab = first; slab < first + count; ++slab) {
            const int k = static_cast<int>(slab);
            for (int j = 0; j < ny; ++j) {
                float* left = cells.cell(layout.at(-1, j, k));
                float* right = cells.cell(layout.at(nx, j, k));
                fillGhost(left, left + lanes, left + 2 * lanes, {0, false, rule.sides[0]}, rule);
                fillGhost(right, right - lanes, right - 2 * lanes, {0, true, rule.sides[1]}, rule);
            }
            fillRow({-1, k}, {0, k}, {1, k}, {1, false, rule.sides[2]});
            fillRow({ny, k}, {ny - 1, k}, {ny - 2, k}, {1, true, rule.sides[3]});
            extendFace({-1, ny, k}, {0, ny, k}, 1);
            extendFace({nx, ny, k}, {nx - 1, ny, k}, 1);
        }
    });
    parallel::forEachBlock(static_cast<std::size_t>(ny) + 2, 16, [&](std::size_t first, std::size_t count) {
        for (std::size_t row = first; row < first + count; ++row) {
            const int j = static_cast<int>(row) - 1;
            fillRow({j, -1}, {j, 0}, {j, 1}, {2, false, rule.sides[4]});
            fillRow({j, nz}, {j, nz - 1}, {j, nz - 2}, {2, true, rule.sides[5]});
        }
    });
    for (int j = 0; j < ny; ++j) {
        extendFace({-1, j, nz}, {0, j, nz}, 2);
        extendFace({nx, j, nz}, {nx - 1, j, nz}, 2);
    }
    for (int i = -1; i <= nx; ++i) {
        extendFace({i, -1, nz}, {i, 0, nz}, 2);
        extendFace({i, ny, nz}, {i, ny - 1, nz}, 2);
    }
    for (int k = -1; k <= nz; ++k) {  // along x the far side's faces of the rows beyond
        extendFace({nx, -1, k}, {nx, 0, k}, 0);
        extendFace({nx, ny, k}, {nx, ny - 1, k}, 0);
    }
}

}  // namespace dustbench::grid_fluid::flow
