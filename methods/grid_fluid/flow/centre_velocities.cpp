#include "methods/grid_fluid/flow/centre_velocities.h"

#include <algorithm>
#include <cstring>

#include "methods/grid_fluid/flow/lanes.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// The velocities at the centres of four cells, four floats each: the means of their faces. The fourth float is unused.
[[gnu::always_inline]] inline Float16 fourCentres(const float* records, std::size_t row, std::size_t slab) {
    const auto low = load<Float16>(records), high = load<Float16>(records + 16);
    const float *above = records + row, *behind = records + slab;
    const Float16 own = __builtin_shufflevector(low, high, 0, 1, 2, 3, 6, 7, 8, 9, 12, 13, 14, 15, 18, 19, 20, 21);
    const Float16 x = __builtin_shufflevector(low, high, 6, 7, 8, 9, 12, 13, 14, 15, 18, 19, 20, 21, 24, 25, 26, 27);
    const Float16 y = __builtin_shufflevector(load<Float16>(above), load<Float16>(above + 16), 0, 1, 2, 3, 6, 7, 8, 9,
                                              12, 13, 14, 15, 18, 19, 20, 21);
    const Float16 z = __builtin_shufflevector(load<Float16>(behind), load<Float16>(behind + 16), 0, 1, 2, 3, 6, 7, 8, 9,
                                              12, 13, 14, 15, 18, 19, 20, 21);
    const Float16 xy = __builtin_shufflevector(x, y, 0, 17, 2, 3, 4, 21, 6, 7, 8, 25, 10, 11, 12, 29, 14, 15);
    const Float16 next = __builtin_shufflevector(xy, z, 0, 1, 18, 3, 4, 5, 22, 7, 8, 9, 26, 11, 12, 13, 30, 15);
    return 0.5f * (own + next);
}

Float4 oneCentre(const float* record, std::size_t row, std::size_t slab) {
    const Float4 next{record[lanes], (record + row)[1], (record + slab)[2], 0};
    return 0.5f * (load<Float4>(record) + next);
}

/// u* = uⁿ + a·(uⁿ − uⁿ⁻¹), limited to the maximum speeds.
class MidStep {
 public:
    explicit MidStep(const Extrapolation& extrapolation)
        : ahead_(extrapolation.ahead),
          one_{extrapolation.maximumSpeeds.x, extrapolation.maximumSpeeds.y, extrapolation.maximumSpeeds.z, 0},
          four_(__builtin_shufflevector(one_, one_, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3)) {}

    /// Four cells; uⁿ replaces uⁿ⁻¹ in `last`.
    [[gnu::always_inline]] Float16 operator()(const Float16& now, float* last) const {
        const auto packed = load<Float16>(last);
        store(last, __builtin_shufflevector(now, now, 0, 1, 2, 4, 5, 6, 8, 9));
        store(last + 8, __builtin_shufflevector(now, now, 10, 12, 13, 14));
        return of(now, __builtin_shufflevector(packed, packed, 0, 1, 2, 2, 3, 4, 5, 5, 6, 7, 8, 8, 9, 10, 11, 11),
                  four_);
    }
    /// One cell.
    [[gnu::always_inline]] Float4 operator()(const Float4& now, float* last) const {
        const Float4 then{last[0], last[1], last[2], 0};
        for (int axis = 0; axis < 3; ++axis) last[axis] = now[axis];
        return of(now, then, one_);
    }

 private:
    template <typename Vector>
    [[gnu::always_inline]] Vector of(const Vector& now, const Vector& last, const Vector& maximum) const {
        return atMost(atLeast(now + ahead_ * (now - last), -maximum), maximum);
    }

    float ahead_;
    Float4 one_;
    Float16 four_;
};

}  // namespace

void CentreVelocities::hold(std::size_t slabs) {
    slabs_ = slabs;
    const std::size_t floats = 4 * slabs * layout_.slab + CellField::floatsBehind;
    if (ring_.size() < floats) ring_.resize(floats);
}

/// Four cells are read with four floats behind them.
std::size_t CentreVelocities::lastFloatsOfRow() const {
    return 3 * static_cast<std::size_t>(layout_.nx) + 4;
}

float* CentreVelocities::lastOfRow(int j, int k) {
    return last_.data() + lastFloatsOfRow() * (static_cast<std::size_t>(k) * static_cast<std::size_t>(layout_.ny) +
                                               static_cast<std::size_t>(j));
}

void CentreVelocities::keepLast() {
    if (last_.empty()) last_.resize(lastFloatsOfRow() * layout_.rows());
}

template <typename StoreAt>
void CentreVelocities::findCells(const CellField& cells, int j, int k, const StoreAt& storeAt) {
    const std::size_t stepY = layout_.row * lanes, stepZ = layout_.slab * lanes;
    const auto nx = static_cast<std::size_t>(layout_.nx);
    const float* record = cells.cell(layout_.at(0, j, k));
    std::size_t i = 0;
    for (; i + 4 <= nx; i += 4) storeAt(i, fourCentres(record + i * lanes, stepY, stepZ));
    for (; i < nx; ++i) storeAt(i, oneCentre(record + i * lanes, stepY, stepZ));
}

void CentreVelocities::findRow(const CellField& cells, const Extrapolation* extrapolation, int j, int k) {
    const int ny = layout_.ny, nz = layout_.nz;
    const auto nx = static_cast<std::size_t>(layout_.nx);
    float *own = row(j, k), *to = own + 4;
    if (extrapolation == nullptr) {
        findCells(cells, j, k, [&](std::size_t i, const auto& now) { store(to + 4 * i, now); });
    } else {
        const MidStep midStep(*extrapolation);
        float* last = lastOfRow(j, k);
        findCells(cells, j, k, [&](std::size_t i, const auto& now) { store(to + 4 * i, midStep(now, last + 3 * i)); });
    }
    const std::size_t cellBytes = 4 * sizeof(float);
    std::memcpy(to - 4, to, cellBytes);
    std::memcpy(to + 4 * nx, to + 4 * (nx - 1), cellBytes);
    for (const int z : {k, k == 0 ? -1 : k, k + 1 == nz ? nz : k})
        for (const int y : {j, j == 0 ? -1 : j, j + 1 == ny ? ny : j})
            if (y != j || z != k) std::memcpy(row(y, z), own, layout_.row * cellBytes);
}

void CentreVelocities::scroll(glm::ivec3 by, glm::vec3 wind) {
    if (last_.empty()) return;
    const int nx = layout_.nx, firstKept = std::clamp(-by.x, 0, nx), lastKept = std::clamp(nx - by.x, firstKept, nx);
    const auto fill = [&](float* to, int from, int end) {
        for (int i = from; i < end; ++i)
            for (int axis = 0; axis < 3; ++axis) to[3 * i + axis] = wind[axis];
    };
    // No row is written before it has been read.
    const bool ascending = by.z > 0 || (by.z == 0 && by.y >= 0);
    for (std::size_t r = 0; r < layout_.rows(); ++r) {
        const std::size_t rowIndex = ascending ? r : layout_.rows() - 1 - r;
        const int j = layout_.rowJ(rowIndex), k = layout_.rowK(rowIndex), fromJ = j + by.y, fromK = k + by.z;
        float* to = lastOfRow(j, k);
        const bool had = fromJ >= 0 && fromJ < layout_.ny && fromK >= 0 && fromK < layout_.nz && firstKept < lastKept;
        if (!had) {
            fill(to, 0, nx);
            continue;
        }
        std::memmove(to + 3 * static_cast<std::ptrdiff_t>(firstKept),
                     lastOfRow(fromJ, fromK) + 3 * static_cast<std::ptrdiff_t>(firstKept + by.x),
                     3 * static_cast<std::size_t>(lastKept - firstKept) * sizeof(float));
        fill(to, 0, firstKept);
        fill(to, lastKept, nx);
    }
}

}  // namespace dustbench::grid_fluid::flow
