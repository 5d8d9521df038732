#include "methods/shared/fluid/advection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/shared/fluid/sampling.h"
#include "methods/shared/parallel/for_each_block.h"

namespace dustbench::fluid {
namespace {

constexpr int slabsAtATime = 4;
constexpr std::size_t rowsInABlock = 8;
constexpr std::size_t mostCells = 4096;

/// Paths through a field, by the midpoint rule: x ∓ Δt·u(x ∓ ½Δt·u(x)).
class Paths {
 public:
    Paths(const RecordView& view, const CellLayout& layout, float cellsPerSpeed)
        : view_(view),
          layout_(layout),
          step_{cellsPerSpeed, cellsPerSpeed, cellsPerSpeed, 0},
          last_{static_cast<float>(layout.nx + 1), static_cast<float>(layout.ny + 1), static_cast<float>(layout.nz + 1),
                0},
          lastCorner_{layout.nx, layout.ny, layout.nz, 0} {}

    [[gnu::always_inline]] Corners around(const Float4& place) const {
        return cornersAround(view_, place, lastCorner_, layout_);
    }
    [[gnu::always_inline]] Float4 back(const Float4& place, const Float4& velocity) const {
        const Float4 middle = inside(place - step_ * 0.5f * velocity);
        return inside(place - step_ * velocityAt(middle));
    }
    /// From where a path began, x₋, to where it will end.
    [[gnu::always_inline]] Float4 mirrored(const Float4& began, const Float4& velocity) const {
        return began + step_ * 2.0f * velocity;
    }

 private:
    [[gnu::always_inline]] Float4 inside(const Float4& place) const {
        return atMost(atLeast(place, Float4{0, 0, 0, 0}), last_);
    }
    [[gnu::always_inline]] Float4 velocityAt(const Float4& place) const {
        const Float8 record = sample(around(place), view_.row);
        return __builtin_shufflevector(record, record, 0, 1, 2, 3);
    }

    RecordView view_;
    CellLayout layout_;
    Float4 step_, last_;
    Int4 lastCorner_;
};

/// Writes two lanes too many, which the next record of the row, or its ghost, will overwrite.
[[gnu::always_inline]] inline void storeRecord(float* record, const Float8& value) {
    store(record, value);
}

[[gnu::always_inline]] inline Float4 centre(int i, int j, int k) {
    return Float4{static_cast<float>(i + 1), static_cast<float>(j + 1), static_cast<float>(k + 1), 0};
}

}  // namespace

struct Advection::Pass {
    const CellField& from;
    CellField& to;
    const std::uint8_t* fluid;
    AdvectionRule rule;
    float cellsPerSpeed;
    int reach;  ///< slabs that a look-up along z may touch, on either side
    RecordView field, window;
};

void Advection::predict(const Pass& pass, int firstSlab, int lastSlab) {
    const bool corrected = pass.rule.scheme == AdvectionScheme::macCormack;
    const Paths paths(pass.field, layout_, pass.cellsPerSpeed);
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const auto row = [&](int j, int k, std::array<Float4, mostCells>& places) {
        const std::size_t at = layout_.at(0, j, k), there = corrected ? inWindow(at) : at;
        const float* own = pass.from.cell(at);
        const std::uint8_t* fluid = pass.fluid + at;
        // The row's paths first, then what is found at their ends: many cells at once are then in flight.
        for (std::size_t i = 0; i < nx; ++i)
            places[i] = paths.back(centre(static_cast<int>(i), j, k), load<Float4>(own + i * lanes));
        float* out = (corrected ? window_.data() : pass.to.data()) + there * lanes;
        for (std::size_t i = 0; i < nx; ++i)
            storeRecord(out + i * lanes, fluid[i] == 1 ? sample(paths.around(places[i]), pass.field.row)
                                                       : load<Float8>(own + i * lanes));
        if (!corrected) return;
        float* kept = places_.data() + there * 3;
        for (std::size_t i = 0; i < nx; ++i) store(kept + i * 3, places[i]);
    };
    parallel::forEachBlock(static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock,
                           [&](std::size_t first, std::size_t count) {
                               std::array<Float4, mostCells> places;
                               for (std::size_t r = first; r < first + count; ++r)
                                   row(layout_.rowJ(r), firstSlab + layout_.rowK(r), places);
                           });
}

void Advection::correct(const Pass& pass, int firstSlab, int lastSlab) {
    const Paths paths(pass.field, layout_, pass.cellsPerSpeed);
    const Paths guesses(pass.window, layout_, pass.cellsPerSpeed);
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const auto row = [&](int j, int k) {
        const std::size_t at = layout_.at(0, j, k), there = inWindow(at);
        const float* own = pass.from.cell(at);
        const float* guess = window_.data() + there * lanes;
        const float* kept = places_.data() + there * 3;
        float* out = pass.to.cell(at);
        const std::uint8_t* fluid = pass.fluid + at;
        // There is no first guess beyond the outermost centres, nor farther along z than the flow is fast.
        const int slabs = pass.reach - 1;
        const Float4 low{1, 1, static_cast<float>(std::max(1, k + 1 - slabs)), 0};
        const Float4 high{static_cast<float>(layout_.nx), static_cast<float>(layout_.ny),
                          static_cast<float>(std::min(layout_.nz, k + 1 + slabs)), 0};
        for (std::size_t i = 0; i < nx; ++i, own += lanes, guess += lanes, kept += 3, out += lanes) {
            const auto first = load<Float8>(guess);
            Float8 value = first;
            const Float4 behind = load<Float4>(kept);
            const Float4 ahead = paths.mirrored(behind, load<Float4>(own));
            const Int4 within = (ahead >= low) & (ahead <= high) & (behind >= low) & (behind <= high);
            if (fluid[i] == 1 && (within[0] & within[1] & within[2]) != 0) {
                // φ = φ̂ + ½(φⁿ − φ̃)
                value += 0.5f * (load<Float8>(own) - sample(guesses.around(ahead), pass.window.row));
                if (pass.rule.limit != Limit::none) {
                    Float8 least, most;
                    extrema(paths.around(behind), pass.field.row, least, most);
                    value = pass.rule.limit == Limit::clamp      ? atMost(atLeast(value, least), most)
                            : (value >= least) & (value <= most) ? value
                                                                 : first;
                }
            }
            storeRecord(out, value);
        }
    };
    parallel::forEachBlock(static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock,
                           [&](std::size_t first, std::size_t count) {
                               for (std::size_t r = first; r < first + count; ++r)
                                   row(layout_.rowJ(r), firstSlab + layout_.rowK(r));
                           });
}

void Advection::advect(const CellField& from, CellField& to, const std::uint8_t* fluid, AdvectionRule rule,
                       float cellsPerSpeed, float mostSpeedZ) {
    const int nz = layout_.nz;
    const auto slabs = static_cast<std::size_t>(nz) + 2;
    const double cells = std::min<double>(nz, std::ceil(static_cast<double>(mostSpeedZ * cellsPerSpeed)));
    const int reach = static_cast<int>(cells) + 2;
    const bool corrected = rule.scheme == AdvectionScheme::macCormack;
    const std::size_t held = std::min(slabs, static_cast<std::size_t>(slabsAtATime + 2 * reach + 1));
    if (corrected && places_.size() < held * layout_.slab * 3) {
        places_.resize(held * layout_.slab * 3 + CellField::floatsBehind);
        window_.resize(held * layout_.slab * lanes + CellField::floatsBehind);
    }
    fieldSlabs_.resize(slabs);
    windowSlabs_.resize(slabs);
    for (std::size_t k = 0; k < slabs; ++k) {
        fieldSlabs_[k] = static_cast<std::uint32_t>(k * layout_.slab);
        windowSlabs_[k] = static_cast<std::uint32_t>(k % held * layout_.slab);
    }
    const std::size_t rowFloats = layout_.row * lanes;
    const Pass pass{from,
                    to,
                    fluid,
                    rule,
                    cellsPerSpeed,
                    reach,
                    {from.data(), rowFloats, fieldSlabs_.data()},
                    {window_.data(), rowFloats, windowSlabs_.data()}};
    if (!corrected) return predict(pass, 0, nz);
    // A slab is corrected as soon as all that its paths can reach is there.
    int done = 0;
    for (int first = 0; first < nz; first += slabsAtATime) {
        const int last = std::min(first + slabsAtATime, nz);
        predict(pass, first, last);
        const int ready = last == nz ? nz : std::max(done, last - reach);
        correct(pass, done, ready);
        done = ready;
    }
}

}  // namespace dustbench::fluid
