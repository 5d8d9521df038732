#include "methods/grid_fluid/flow/advection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/grid_fluid/flow/sampling.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr int slabsAtATime = 4;
constexpr std::size_t rowsInABlock = 8;

/// Writes two extra lanes, which the next record of the row, or its ghost, will overwrite.
[[gnu::always_inline]] inline void storeRecord(float* record, const Float8& value) {
    store(record, value);
}

constexpr Float16 upwards{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

}  // namespace

struct Advection::Pass {
    const CellField& from;
    CellField& to;
    const std::uint8_t* fluid;
    AdvectionRule rule;
    float cellsPerSpeed;
    int reach;  ///< slabs that a sample along z may touch, on either side
    RecordView field, window;
};

/// Departure points of a row's cells.
struct Advection::KeptRow {
    float* x = nullptr;
    std::size_t pitch = 0;

    void put(std::size_t i, const Triples& places) const {
        store(x + i, places.x);
        store(x + pitch + i, places.y);
        store(x + 2 * pitch + i, places.z);
    }
    [[nodiscard]] Triples get(std::size_t i) const {
        return {load<Float16>(x + i), load<Float16>(x + pitch + i), load<Float16>(x + 2 * pitch + i)};
    }
};

Advection::KeptRow Advection::keptRow(int j, int k) {
    const auto row =
        static_cast<std::size_t>(k) % heldSlabs_ * static_cast<std::size_t>(layout_.ny) + static_cast<std::size_t>(j);
    return {places_.data() + row * 3 * keptPitch_, keptPitch_};
}

/// The paths of a row's cells, by the midpoint rule: x₋ = x − Δt·u(x − ½Δt·u(x)), and the samples at their ends.
void Advection::predict(const Pass& pass, int firstSlab, int lastSlab) {
    const bool corrected = pass.rule.scheme == AdvectionScheme::macCormack;
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const float step = pass.cellsPerSpeed;
    struct Strip {
        CornerStrip<false> corners;
        /// Samples at the midpoint; only the velocities are used.
        alignas(64) std::array<float, (stripCells + 1) * lanes> halfway{};
    };
    const auto predictStrip = [&](std::size_t first, std::size_t count, int j, int k, Strip& strip) {
        auto& [corners, halfway] = strip;
        const std::size_t at = layout_.at(0, j, k) + first, there = corrected ? inWindow(at) : at;
        const float* own = pass.from.cell(at);
        const std::uint8_t* fluid = pass.fluid + at;
        // Back from the centres of sixteen cells, clamped to the outermost ghost cells.
        const auto back = [&](std::size_t i, float steps, const Triples& velocities) {
            const auto from = [&](const Float16& centres, const Float16& velocity, int cells) {
                const Float16 place = fused(everywhere<Float16>(-steps), velocity, centres);
                return atMost(atLeast(place, Float16{}), everywhere<Float16>(static_cast<float>(cells + 1)));
            };
            return Triples{from(static_cast<float>(first + i + 1) + upwards, velocities.x, layout_.nx),
                           from(everywhere<Float16>(static_cast<float>(j + 1)), velocities.y, layout_.ny),
                           from(everywhere<Float16>(static_cast<float>(k + 1)), velocities.z, layout_.nz)};
        };
        corners.find(count, [&](std::size_t i) { return back(i, 0.5f * step, velocitiesOf(own + i * lanes)); });
        const CornerStrip<false>::Reader field(corners);
        for (std::size_t i = 0; i < count; ++i) storeRecord(&halfway[i * lanes], field.sample(i));
        const KeptRow kept = corrected ? keptRow(j, k) : KeptRow{};
        corners.find(count, [&](std::size_t i) {
            const Triples behind = back(i, step, velocitiesOf(&halfway[i * lanes]));
            if (corrected) kept.put(first + i, behind);
            return behind;
        });
        float* out = (corrected ? window_.data() : pass.to.data()) + there * lanes;
        for (std::size_t i = 0; i < count; ++i)
            storeRecord(out + i * lanes, fluid[i] == 1 ? field.sample(i) : load<Float8>(own + i * lanes));
    };
    parallel::forEachBlock(
        static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock, [&](std::size_t first, std::size_t count) {
            Strip strip{CornerStrip<false>(pass.field, layout_)};
            for (std::size_t r = first; r < first + count; ++r)
                for (std::size_t i = 0; i < nx; i += stripCells)
                    predictStrip(i, std::min(stripCells, nx - i), layout_.rowJ(r), firstSlab + layout_.rowK(r), strip);
        });
}

/// φ = φ̂ + ½(φⁿ − φ̃), where φ̃ is the first guess sampled along the forward path.
void Advection::correct(const Pass& pass, int firstSlab, int lastSlab) {
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const auto twoSteps = everywhere<Float16>(2 * pass.cellsPerSpeed);
    struct Strip {
        CornerStrip<false> began;
        CornerStrip<true> guesses;
        alignas(64) std::array<int, stripCells> within{};
    };
    const auto correctStrip = [&](std::size_t firstCell, std::size_t count, int j, int k, Strip& strip) {
        auto& [began, guesses, within] = strip;
        const std::size_t at = layout_.at(0, j, k) + firstCell, there = inWindow(at);
        const float* own = pass.from.cell(at);
        const float* guess = window_.data() + there * lanes;
        // The first guess is undefined beyond the outermost centres, and farther along z than the maximum speed.
        const int slabs = pass.reach - 1, lowest = std::max(1, k + 1 - slabs);
        const std::array<int, 3> low{1, 1, lowest}, high{layout_.nx, layout_.ny, std::min(layout_.nz, k + 1 + slabs)};
        const KeptRow kept = keptRow(j, k);
        guesses.lookFrom(lowest);
        guesses.find(count, [&](std::size_t i) {
            const Triples velocity = velocitiesOf(own + i * lanes), from = kept.get(firstCell + i);
            Int16 isWithin = Int16{} - 1;
            const auto to = [&](const Float16& velocityAlong, const Float16& fromAlong, std::size_t axis) {
                const auto minimum = everywhere<Float16>(static_cast<float>(low[axis]));
                const auto maximum = everywhere<Float16>(static_cast<float>(high[axis]));
                const Float16 place = fused(twoSteps, velocityAlong, fromAlong);
                isWithin &= (place >= minimum) & (place <= maximum) & (fromAlong >= minimum) & (fromAlong <= maximum);
                return atMost(atLeast(place, minimum), maximum);
            };
            const Triples ahead{to(velocity.x, from.x, 0), to(velocity.y, from.y, 1), to(velocity.z, from.z, 2)};
            store(&within[i], isWithin);
            return ahead;
        });
        began.find(count, [&](std::size_t i) { return kept.get(firstCell + i); });
        const CornerStrip<true>::Reader ahead(guesses);
        const CornerStrip<false>::Reader field(began);
        const Limit limit = pass.rule.limit;
        const std::uint8_t* fluid = pass.fluid + at;
        float* out = pass.to.cell(at);
        for (std::size_t i = 0; i < count; ++i, own += lanes, guess += lanes, out += lanes) {
            const auto first = load<Float8>(guess);
            Float8 value = first;
            if (fluid[i] == 1 && within[i] != 0) {
                value += 0.5f * (load<Float8>(own) - ahead.sample(i));
                if (limit != Limit::none) {
                    Float8 minimum, maximum;
                    field.extrema(i, minimum, maximum);
                    value = limit == Limit::clamp                       ? atMost(atLeast(value, minimum), maximum)
                            : ((value >= minimum) & (value <= maximum)) ? value
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
                       float cellsPerSpeed, float maximumSpeedZ) {
    const int nz = layout_.nz;
    const auto slabs = static_cast<std::size_t>(nz) + 2;
    const double cells = std::min<double>(nz, std::ceil(static_cast<double>(maximumSpeedZ * cellsPerSpeed)));
    const int reach = static_cast<int>(cells) + 2;
    const bool corrected = rule.scheme == AdvectionScheme::macCormack;
    const std::size_t held = std::min(slabs, static_cast<std::size_t>(slabsAtATime + 2 * reach + 1));
    keptPitch_ = (static_cast<std::size_t>(layout_.nx) + SixteenRecords::count - 1) & ~(SixteenRecords::count - 1);
    if (corrected && window_.size() < held * layout_.slab * lanes) {
        places_.resize(held * static_cast<std::size_t>(layout_.ny) * keptPitch_ * 3);
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
    // A slab is corrected as soon as all slabs that its paths can reach are available.
    int done = 0;
    for (int first = 0; first < nz; first += slabsAtATime) {
        const int last = std::min(first + slabsAtATime, nz);
        predict(pass, first, last);
        const int ready = last == nz ? nz : std::max(done, last - reach);
        correct(pass, done, ready);
        done = ready;
    }
}

}  // namespace dustbench::grid_fluid::flow
