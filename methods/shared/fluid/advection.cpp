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

/// Writes two lanes too many, which the next record of the row, or its ghost, will overwrite.
[[gnu::always_inline]] inline void storeRecord(float* record, const Float8& value) {
    store(record, value);
}

[[gnu::always_inline]] inline Float4 velocityOf(const Float8& record) {
    return __builtin_shufflevector(record, record, 0, 1, 2, 3);
}

/// Of four cells at once: all bits set where all three numbers of a cell are.
[[gnu::always_inline]] inline Int4 allThree(Int16 mask) {
    mask &= __builtin_shufflevector(mask, mask, 1, 2, 0, 3, 5, 6, 4, 7, 9, 10, 8, 11, 13, 14, 12, 15);
    mask &= __builtin_shufflevector(mask, mask, 2, 0, 1, 3, 6, 4, 5, 7, 10, 8, 9, 11, 14, 12, 13, 15);
    return __builtin_shufflevector(mask, mask, 0, 4, 8, 12);
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

    [[nodiscard]] Float4 step() const { return Float4{cellsPerSpeed, cellsPerSpeed, cellsPerSpeed, 0}; }
};

/// The paths of a row's cells, by the midpoint rule: x₋ = x − Δt·u(x − ½Δt·u(x)), and what lies at their ends.
void Advection::predict(const Pass& pass, int firstSlab, int lastSlab) {
    const bool corrected = pass.rule.scheme == AdvectionScheme::macCormack;
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const Float4 step = pass.step(), halfStep = 0.5f * step;
    const Float4 last{static_cast<float>(layout_.nx + 1), static_cast<float>(layout_.ny + 1),
                      static_cast<float>(layout_.nz + 1), 0};
    const auto inside = [&](const Float4& place) { return atMost(atLeast(place, Float4{}), last); };
    struct Strip {
        CornerStrip<false> corners;
        Places places{};
    };
    const auto predictStrip = [&](std::size_t first, std::size_t count, int j, int k, Strip& strip) {
        auto& [corners, places] = strip;
        const std::size_t at = layout_.at(0, j, k) + first, there = corrected ? inWindow(at) : at;
        const float* own = pass.from.cell(at);
        const std::uint8_t* fluid = pass.fluid + at;
        const Float4 before{static_cast<float>(first + 1), static_cast<float>(j + 1), static_cast<float>(k + 1), 0};
        const auto centre = [&](std::size_t i) { return before + Float4{static_cast<float>(i), 0, 0, 0}; };
        for (std::size_t i = 0; i < count; ++i)
            places[i] = inside(centre(i) - halfStep * load<Float4>(own + i * lanes));
        corners.find(places, count);
        for (std::size_t i = 0; i < count; ++i) places[i] = inside(centre(i) - step * velocityOf(corners.sample(i)));
        corners.find(places, count);
        float* out = (corrected ? window_.data() : pass.to.data()) + there * lanes;
        for (std::size_t i = 0; i < count; ++i)
            storeRecord(out + i * lanes, fluid[i] == 1 ? corners.sample(i) : load<Float8>(own + i * lanes));
        if (!corrected) return;
        float* kept = places_.data() + there * 3;
        for (std::size_t i = 0; i < count; ++i) store(kept + i * 3, places[i]);
    };
    parallel::forEachBlock(
        static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock, [&](std::size_t first, std::size_t count) {
            Strip strip{CornerStrip<false>(pass.field, layout_)};
            for (std::size_t r = first; r < first + count; ++r)
                for (std::size_t i = 0; i < nx; i += stripCells)
                    predictStrip(i, std::min(stripCells, nx - i), layout_.rowJ(r), firstSlab + layout_.rowK(r), strip);
        });
}

/// φ = φ̂ + ½(φⁿ − φ̃), where φ̃ is the first guess looked up along the path ahead.
void Advection::correct(const Pass& pass, int firstSlab, int lastSlab) {
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const Float4 twoSteps = 2 * pass.step();
    struct Strip {
        CornerStrip<false> began;
        CornerStrip<true> guesses;
        Places behind{}, ahead{};
        alignas(16) std::array<int, stripCells> within{};
    };
    const auto correctStrip = [&](std::size_t firstCell, std::size_t count, int j, int k, Strip& strip) {
        auto& [began, guesses, behind, ahead, within] = strip;
        const std::size_t at = layout_.at(0, j, k) + firstCell, there = inWindow(at);
        const float* own = pass.from.cell(at);
        const float* guess = window_.data() + there * lanes;
        const float* kept = places_.data() + there * 3;
        // There is no first guess beyond the outermost centres, nor farther along z than the flow is fast.
        const int slabs = pass.reach - 1, lowest = std::max(1, k + 1 - slabs);
        const Float16 low = fourTimes(Float4{1, 1, static_cast<float>(lowest), 0});
        const Float16 high = fourTimes(Float4{static_cast<float>(layout_.nx), static_cast<float>(layout_.ny),
                                              static_cast<float>(std::min(layout_.nz, k + 1 + slabs)), 0});
        const Float4 threeOnly{1, 1, 1, 0};
        for (std::size_t i = 0; i < count; ++i) {
            behind[i] = load<Float4>(kept + i * 3) * threeOnly;
            ahead[i] = behind[i] + twoSteps * load<Float4>(own + i * lanes);
        }
        for (std::size_t i = 0; i < count; i += 4) {
            const Float16 from = fourPlaces(behind, i), to = fourPlaces(ahead, i);
            store(&within[i], allThree((to >= low) & (to <= high) & (from >= low) & (from <= high)));
            store(reinterpret_cast<float*>(&ahead[i]), atMost(atLeast(to, low), high));
        }
        guesses.lookFrom(lowest);
        guesses.find(ahead, count);
        began.find(behind, count);
        const std::uint8_t* fluid = pass.fluid + at;
        float* out = pass.to.cell(at);
        for (std::size_t i = 0; i < count; ++i, own += lanes, guess += lanes, out += lanes) {
            const auto first = load<Float8>(guess);
            Float8 value = first;
            if (fluid[i] == 1 && within[i] != 0) {
                value += 0.5f * (load<Float8>(own) - guesses.sample(i));
                if (pass.rule.limit != Limit::none) {
                    Float8 least, most;
                    began.extrema(i, least, most);
                    value = pass.rule.limit == Limit::clamp      ? atMost(atLeast(value, least), most)
                            : (value >= least) & (value <= most) ? value
                                                                 : first;
                }
            }
            storeRecord(out, value);
        }
    };
    parallel::forEachBlock(
        static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock, [&](std::size_t first, std::size_t count) {
            Strip strip{CornerStrip<false>(pass.field, layout_), CornerStrip<true>(pass.window, layout_)};
            for (std::size_t r = first; r < first + count; ++r)
                for (std::size_t i = 0; i < nx; i += stripCells)
                    correctStrip(i, std::min(stripCells, nx - i), layout_.rowJ(r), firstSlab + layout_.rowK(r), strip);
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
    heldSlabs_ = held;
    const Pass pass{from,
                    to,
                    fluid,
                    rule,
                    cellsPerSpeed,
                    reach,
                    {from.data(), static_cast<int>(slabs)},
                    {window_.data(), static_cast<int>(held)}};
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
