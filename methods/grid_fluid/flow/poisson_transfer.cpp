// Transfer between a grid of the pressure's hierarchy and the next coarser one.
#include <algorithm>
#include <cstring>

#include "methods/grid_fluid/flow/poisson_level.h"
#include "methods/grid_fluid/flow/poisson_rows.h"

namespace dustbench::grid_fluid::flow {

void PoissonLevel::readFaces(int axis, int j, int k, FaceRow& row) const {
    const auto nx = static_cast<std::size_t>(layout.nx);
    if (finest) {
        const std::uint8_t* own = conductance_ + cells_.at(-1, j, k);
        const std::uint8_t* next = own + (axis == 0 ? 1 : axis == 1 ? cells_.row : cells_.slab);
        loop(nx + 1, [&](std::size_t i) { row[i] += static_cast<float>(own[i] * next[i]); });
        return;
    }
    const std::size_t at = layout.at(j, k);
    const float* even = faces_[axis].colour[(j + k) & 1] + at;
    const float* odd = faces_[axis].colour[(1 + j + k) & 1] + at;
    if (axis == 0) row[0] += odd[-1];
    loop(nx / 2, [&](std::size_t m) {
        row[2 * m + 1] += even[m];
        row[2 * m + 2] += odd[m];
    });
    if (nx % 2 != 0) row[nx] += even[nx / 2];
}

void PoissonLevel::buildFrom(const PoissonLevel& finer) {
    const SplitLayout& fine = finer.layout;
    const auto nx = static_cast<std::size_t>(layout.nx), fineNx = static_cast<std::size_t>(fine.nx);
    // The face behind coarse cell I is the one behind finer cell 2I + 1, or behind the last cell.
    const auto behind = [](int coarse, int cells) { return std::min(2 * coarse + 1, cells - 1); };
    // The face behind a coarse cell lies between centres twice as far apart. At an odd end the last coarse cell is a
    // single finer cell: its centre is 1½ times as far from the previous one, and no farther from the side.
    const auto scale = [](int coarse, int cells) {
        const int last = (cells + 1) / 2 - 1;
        if (cells == 1) return 1.0f;
        if (cells % 2 == 0 || coarse < last - 1) return 0.5f;
        return coarse == last ? 1.0f : 2.0f / 3;
    };
    const auto write = [&](SplitField& faces, int j, int k, const FaceRow& row) {
        float* even = faces.colour[(j + k) & 1] + layout.at(j, k);
        float* odd = faces.colour[(1 + j + k) & 1] + layout.at(j, k);
        for (std::size_t m = 0; m < layout.half; ++m) {
            even[m] = row[2 * m];
            odd[m] = 2 * m + 1 < nx ? row[2 * m + 1] : 0.0f;
        }
    };
    // The faces across y or z of two rows of finer cells, two by two along x.
    const auto across = [&](int axis, int j, int k, int fineJ, int fineK) {
        FaceRow sums, row;
        std::fill_n(sums.data(), fineNx + 2, 0.0f);
        const int other = axis == 1 ? fineK : fineJ, last = axis == 1 ? fine.nz : fine.ny;
        for (int r = other; r < std::min(other + 2, last); ++r)
            finer.readFaces(axis, axis == 1 ? fineJ : r, axis == 1 ? r : fineK, sums);
        const float half = axis == 1 ? scale(j, fine.ny) : scale(k, fine.nz);
        sums[fineNx + 1] = 0;
        loop(nx, [&](std::size_t i) { row[i] = half * (sums[2 * i + 1] + sums[2 * i + 2]); });
        write(faces_[axis], j, k, row);
    };
    forRows(layout, [&](int j, int k) {
        FaceRow sums, row;
        std::fill_n(sums.data(), fineNx + 2, 0.0f);
        for (int z = 2 * k; z < std::min(2 * k + 2, fine.nz); ++z)
            for (int y = 2 * j; y < std::min(2 * j + 2, fine.ny); ++y) finer.readFaces(0, y, z, sums);
        loop(nx - 1, [&](std::size_t i) { row[i] = 0.5f * sums[2 * i + 2]; });
        if (nx > 1) row[nx - 2] = scale(layout.nx - 2, fine.nx) * sums[2 * nx - 2];
        row[nx - 1] = scale(layout.nx - 1, fine.nx) * sums[fineNx];
        write(faces_[0], j, k, row);
        faces_[0].cell(layout, -1, j, k) = scale(-1, fine.nx) * sums[0];
        across(1, j, k, behind(j, fine.ny), 2 * k);
        across(2, j, k, 2 * j, behind(k, fine.nz));
        if (j == 0) across(1, -1, k, -1, 2 * k);
        if (k == 0) across(2, j, -1, 2 * j, -1);
    });
    forRows(layout, [&](int j, int k) {
        for (int colour = 0; colour < 2; ++colour) {
            const Around w = facesOfRow(layout, faces_, colour, j, k);
            float* sum = sum_.colour[colour] + layout.at(j, k);
            loop(layout.half, [&](std::size_t m) {
                sum[m] = (w.here[m] + w.beside[m]) + (w.below[m] + w.above[m]) + (w.near[m] + w.far[m]);
            });
            // An odd row has no cell of this colour at its end, but the loop computes a sum there.
            const bool odd = ((colour + j + k) & 1) != 0;
            if (odd && layout.nx % 2 != 0) sum[layout.half - 1] = 0;
        }
    });
}

float PoissonLevel::restrictTo(PoissonLevel& coarse, int lastK) const {
    const SplitLayout& to = coarse.layout;
    const int K = lastK / 2;
    float maximum = 0;
    for (int J = 0; J < to.ny; ++J) {
        float sums[2064];
        std::fill_n(sums, layout.row, 0.0f);
        // The red cell of fine columns 2I and 2I + 1 has index I in every row.
        for (int k = 2 * K; k <= lastK; ++k)
            for (int j = 2 * J; j < std::min(2 * J + 2, layout.ny); ++j)
                maximum = std::max(maximum, rowResidual<true>(0, j, k, sums));
        const int firstColour = (J + K) & 1;
        float* even = coarse.rightSide.colour[firstColour] + to.at(J, K);
        float* odd = coarse.rightSide.colour[1 - firstColour] + to.at(J, K);
        loop(to.half, [&](std::size_t m) {
            even[m] = sums[2 * m];
            odd[m] = sums[2 * m + 1];
        });
    }
    return maximum;
}

void PoissonLevel::fillNatural(const std::uint8_t (&openSides)[6]) {
    const int nx = layout.nx, ny = layout.ny, nz = layout.nz;
    const auto sign = [&](int side) { return openSides[side] != 0 ? -1.0f : 1.0f; };
    const auto rowOf = [&](int j, int k) { return natural_ + cells_.at(0, j, k); };
    const auto ends = [&](float* row) {
        row[-1] = sign(0) * row[0];
        row[nx] = sign(1) * row[nx - 1];
    };
    forRows(layout, [&](int j, int k) {
        const int first = (j + k) & 1;
        const float* even = pressure.colour[first] + layout.at(j, k);
        const float* odd = pressure.colour[1 - first] + layout.at(j, k);
        const float* evenSum = sum_.colour[first] + layout.at(j, k);
        const float* oddSum = sum_.colour[1 - first] + layout.at(j, k);
        float* row = rowOf(j, k);
        float minimum = 1;
        for (int i = 0; i + 1 < nx; i += 2) {
            row[i] = even[i / 2];
            row[i + 1] = odd[i / 2];
            minimum = std::min(minimum, std::min(evenSum[i / 2], oddSum[i / 2]));
        }
        if (nx % 2 != 0) {
            row[nx - 1] = even[nx / 2];
            minimum = std::min(minimum, evenSum[nx / 2]);
        }
        if (minimum <= 0) {
            // Coarse cells that are entirely solid take values from the adjacent fluid.
            for (int i = 0; i < nx; ++i) {
                if (sum_.cell(layout, i, j, k) > 0) continue;
                float sum = 0, found = 0;
                const auto add = [&](int x, int y, int z) {
                    if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) return;
                    if (sum_.cell(layout, x, y, z) <= 0) return;
                    sum += pressure.cell(layout, x, y, z);
                    found += 1;
                };
                add(i - 1, j, k), add(i + 1, j, k), add(i, j - 1, k);
                add(i, j + 1, k), add(i, j, k - 1), add(i, j, k + 1);
                row[i] = found > 0 ? sum / found : 0.0f;
            }
        }
        ends(row);
    });
    const auto copy = [&](float* to, const float* from, float factor) {
        for (int i = -1; i <= nx; ++i) to[i] = factor * from[i];
    };
    for (int k = 0; k < nz; ++k) {
        copy(rowOf(-1, k), rowOf(0, k), sign(2));
        copy(rowOf(ny, k), rowOf(ny - 1, k), sign(3));
    }
    for (int j = -1; j <= ny; ++j) {
        copy(rowOf(j, -1), rowOf(j, 0), sign(4));
        copy(rowOf(j, nz), rowOf(j, nz - 1), sign(5));
    }
}

void PoissonLevel::addToBlack(const PoissonLevel& coarse, int k) {
    const CellLayout& from = coarse.cells_;
    constexpr float nearest = overcorrection * 0.75f * 0.75f, near = overcorrection * 0.75f * 0.25f,
                    far = overcorrection * 0.25f * 0.25f;
    for (int j = 0; j < layout.ny; ++j) {
        const int neighbourJ = (j >> 1) + ((j & 1) != 0 ? 1 : -1), neighbourK = (k >> 1) + ((k & 1) != 0 ? 1 : -1);
        const float* a = coarse.natural_ + from.at(-1, j >> 1, k >> 1);
        const float* b = coarse.natural_ + from.at(-1, neighbourJ, k >> 1);
        const float* c = coarse.natural_ + from.at(-1, j >> 1, neighbourK);
        const float* d = coarse.natural_ + from.at(-1, neighbourJ, neighbourK);
        float column[2050];
        loop(static_cast<std::size_t>(from.nx) + 2,
             [&](std::size_t m) { column[m] = nearest * a[m] + near * (b[m] + c[m]) + far * d[m]; });
        // Black cells of columns 2m or 2m + 1: closer to the previous or to the next coarse cell.
        const bool odd = ((1 + j + k) & 1) != 0;
        const float* own = column + 1;
        const float* beside = odd ? column + 2 : column;
        float* p = pressure.colour[1] + layout.at(j, k);
        const std::size_t count = std::min<std::size_t>(layout.half, static_cast<std::size_t>(from.nx));
        if (finest) {
            const std::uint8_t* weights = bytes_[1] + layout.at(j, k);
            loop(count, [&](std::size_t m) {
                const float more = 0.75f * own[m] + 0.25f * beside[m];
                p[m] = weights[m] != 0 ? p[m] + more : p[m];
            });
        } else {
            const float* weights = sum_.colour[1] + layout.at(j, k);
            loop(count, [&](std::size_t m) {
                const float more = 0.75f * own[m] + 0.25f * beside[m];
                p[m] = weights[m] > 0 ? p[m] + more : p[m];
            });
        }
    }
}

}  // namespace dustbench::grid_fluid::flow
