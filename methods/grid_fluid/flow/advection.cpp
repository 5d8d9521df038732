#include "methods/grid_fluid/flow/advection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "methods/grid_fluid/flow/evened_corrections.h"
#include "methods/grid_fluid/flow/sampling.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr int slabsAtATime = 4;
constexpr std::size_t rowsInABlock = 8;
constexpr std::size_t together = SixteenRecords::count;
using FieldStrip = CornerStrip<Memory::whole, Reads::samples>;
using ExtremaStrip = CornerStrip<Memory::whole, Reads::extrema>;
using WindowStrip = CornerStrip<Memory::ring, Reads::samples>;
/// Cells by which a path may leave the region: along a wall speeds across it are rounding errors.
constexpr float almost = pathTolerance;

/// Writes two extra lanes, which the next record of the row, or its ghost, will overwrite.
[[gnu::always_inline]] inline void storeRecord(float* record, const Float8& value) {
    store(record, value);
}

void storeFirst(float* to, const Float16& values, std::size_t count) {
    if (count >= together)
        store(to, values);
    else
        std::memcpy(to, &values, count * sizeof(float));
}

/// Sixteen vectors of four floats by component; the fourth is left out.
Triples byComponent(const float* vectors) {
    const auto a = load<Float16>(vectors), b = load<Float16>(vectors + 16), c = load<Float16>(vectors + 32),
               d = load<Float16>(vectors + 48);
    const auto every4th = [](const Float16& p, const Float16& q, auto first) {
        constexpr int f = decltype(first)::value;
        return __builtin_shufflevector(p, q, f, f + 4, f + 8, f + 12, f + 16, f + 20, f + 24, f + 28, 0, 0, 0, 0, 0, 0,
                                       0, 0);
    };
    const auto component = [&](auto first) {
        const Float16 low = every4th(a, b, first), high = every4th(c, d, first);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23);
    };
    return {component(std::integral_constant<int, 0>{}), component(std::integral_constant<int, 1>{}),
            component(std::integral_constant<int, 2>{})};
}

constexpr Float16 upwards{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

using Int8 = int __attribute__((vector_size(32)));

/// The quantities that move from `value`, the others from `own`.
[[gnu::always_inline]] inline Float8 chosen(Moving moving, const Float8& value, const Float8& own) {
    constexpr Int8 bits{1, 2, 4, 8, 8, 8, 8, 8};
    return ((Int8{} + moving) & bits) != 0 ? value : own;
}

/// The places of sixteen cells of a row, and of their faces.
[[gnu::always_inline]] inline Triples here(std::size_t cell, int j, int k) {
    return {static_cast<float>(cell + 1) + upwards, everywhere<Float16>(static_cast<float>(j + 1)),
            everywhere<Float16>(static_cast<float>(k + 1))};
}

[[gnu::always_inline]] inline Triples moved(const Triples& from, float step, const Triples& velocity) {
    const auto by = everywhere<Float16>(step);
    return {fused(by, velocity.x, from.x), fused(by, velocity.y, from.y), fused(by, velocity.z, from.z)};
}

/// x₋ = x − Δt·u
[[gnu::always_inline]] inline PlacesOfCells began(const PlacesOfCells& velocities, const Triples& place, float step,
                                                  const CellLayout& layout) {
    const auto from = [&](const Triples& velocity) { return inBox(moved(place, -step, velocity), layout); };
    return {from(velocities[0]), from(velocities[1]), from(velocities[2]), from(velocities[3])};
}

/// Where a path must stay to be corrected: between the places that move, and no farther along z than the greatest
/// speed.
class Region {
 public:
    Region(const CellLayout& layout, int k, int reach) : high_{layout.nx, layout.ny, layout.nz} {
        lowestZ_ = std::max(1, k + 1 - (reach - 1));
        highestZ_ = k + 1 + (reach - 1);
    }
    [[nodiscard]] int lowestSlab() const { return lowestZ_; }
    /// Moves sixteen places to the ends of their paths, limited to the region. Returns -1 where both ends lie within.
    [[gnu::always_inline]] Int16 lead(Triples& place, const Triples& end, std::size_t kind) const {
        Int16 within = Int16{} - 1;
        const auto along = [&](Float16& from, const Float16& to, int low, int high) {
            const auto minimum = everywhere<Float16>(static_cast<float>(low));
            const auto maximum = everywhere<Float16>(static_cast<float>(high));
            const auto isWithin = [&](const Float16& at) {
                return (at >= minimum - almost) & (at <= maximum + almost);
            };
            within &= isWithin(to) & isWithin(from);
            from = atMost(atLeast(to, minimum), maximum);
        };
        const auto last = [&](std::size_t axis) { return high_[axis] + (axis == kind ? 1 : 0); };
        along(place.x, end.x, 1, last(0));
        along(place.y, end.y, 1, last(1));
        along(place.z, end.z, lowestZ_, std::min(last(2), highestZ_));
        return within;
    }

 private:
    std::array<int, 3> high_;
    int lowestZ_, highestZ_;
};

}  // namespace

struct Advection::Pass {
    CellField& cells;
    CellField& spare;  ///< of the semi-Lagrangian scheme the result, of MacCormack's the corrections
    const Moving* moving;
    AdvectionRule rule;
    AdvectionStep step;
    int reach;  ///< slabs that a sample along z may touch, on either side
    RecordView field, window;
};

/// Velocities of a row in the window, at its cells and faces.
class Advection::Row {
 public:
    Row(Advection& of, Kept array, int j, int k) {
        const CellLayout& layout = of.layout_;
        const std::size_t at = of.inWindow(layout.at(0, j, k)), slabBefore = of.inWindow(layout.at(0, j, k - 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float* all = of.velocities(array + axis);
            own_[axis] = all + at;
            below_[axis] = all + at - layout.row;
            before_[axis] = all + slabBefore;
        }
    }
    /// A face has the mean of its two cells.
    [[nodiscard]] PlacesOfCells at(std::size_t i) const {
        const Triples own = at(own_, i);
        return {mean(own, atLeft(i)), mean(own, at(below_, i)), mean(own, at(before_, i)), own};
    }

 private:
    using Pointers = std::array<const float*, 3>;
    static Triples at(const Pointers& from, std::size_t i) {
        return {load<Float16>(from[0] + i), load<Float16>(from[1] + i), load<Float16>(from[2] + i)};
    }
    [[nodiscard]] Triples atLeft(std::size_t i) const {
        return {load<Float16>(own_[0] + i - 1), load<Float16>(own_[1] + i - 1), load<Float16>(own_[2] + i - 1)};
    }
    static Triples mean(const Triples& a, const Triples& b) {
        return {0.5f * (a.x + b.x), 0.5f * (a.y + b.y), 0.5f * (a.z + b.z)};
    }
    Pointers own_, below_, before_;
};

void Advection::hold(std::size_t slabs) {
    heldSlabs_ = slabs;
    const std::size_t floats = (lanes + kept) * slabs * layout_.slab + 2 * CellField::floatsBehind;
    if (window_.size() < floats) window_.resize(floats);
}

/// The velocity half-way along the path of a cell, u(x − ½Δt·u(x)).
void Advection::findPathsOfRow(const Pass& pass, int j, int k) {
    const auto nx = static_cast<std::size_t>(layout_.nx);
    const std::size_t at = inWindow(layout_.at(0, j, k));
    const float* centres = centres_.slab(k) + layout_.at(0, j, -1) * 4;
    CentreStrip strip(centres_.data(), static_cast<int>(centres_.slabs()), layout_);
    strip.lookFrom(std::max(k + 1 - pass.reach, 0));
    alignas(64) std::array<float, 4 * together> found;
    for (std::size_t i = 0; i < nx; i += together) {
        const std::size_t count = nx - i;
        const Triples speed = byComponent(centres + 4 * i);
        const auto back = [&](const Float16& place, const Float16& velocity, int cells) {
            const Float16 middle = fused(everywhere<Float16>(-0.5f * pass.step.cellsPerSpeed), velocity, place);
            return atMost(atLeast(middle, Float16{}), everywhere<Float16>(static_cast<float>(cells + 1)));
        };
        strip.find({back(static_cast<float>(i + 1) + upwards, speed.x, layout_.nx),
                    back(everywhere<Float16>(static_cast<float>(j + 1)), speed.y, layout_.ny),
                    back(everywhere<Float16>(static_cast<float>(k + 1)), speed.z, layout_.nz)});
        for (std::size_t c = 0; c < std::min(count, together); ++c) store(&found[4 * c], strip.sample(c));
        const Triples middle = byComponent(found.data());
        const std::array<const Float16*, kept> all{&speed.x, &speed.y, &speed.z, &middle.x, &middle.y, &middle.z};
        for (std::size_t array = 0; array < kept; ++array) storeFirst(velocities(array) + at + i, *all[array], count);
    }
    // The face of the first cell has no other cell in the box.
    for (std::size_t array = 0; array < kept; ++array) velocities(array)[at - 1] = velocities(array)[at];
}

void Advection::findPaths(const Pass& pass, int firstSlab, int lastSlab) {
    const std::size_t rows = static_cast<std::size_t>(lastSlab - firstSlab) * static_cast<std::size_t>(layout_.ny);
    parallel::forEachBlock(rows, rowsInABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r)
            findPathsOfRow(pass, layout_.rowJ(r), firstSlab + layout_.rowK(r));
    });
    const std::size_t rowBytes = layout_.row * sizeof(float), slabBytes = layout_.slab * sizeof(float);
    for (std::size_t array = 0; array < kept; ++array) {
        float* all = velocities(array);
        for (int k = firstSlab; k < lastSlab; ++k)
            std::memcpy(all + inWindow(layout_.at(-1, -1, k)), all + inWindow(layout_.at(-1, 0, k)), rowBytes);
        if (firstSlab == 0)
            std::memcpy(all + inWindow(layout_.at(-1, -1, -1)), all + inWindow(layout_.at(-1, -1, 0)), slabBytes);
    }
}

/// The first guess: the sample at the beginning of each path, x₋ = x − Δt·u.
void Advection::predict(const Pass& pass, int firstSlab, int lastSlab) {
    const bool corrected = pass.rule.scheme == AdvectionScheme::macCormack;
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const float step = pass.step.cellsPerSpeed;
    const auto predictStrip = [&](std::size_t first, std::size_t count, int j, int k, FieldStrip& corners) {
        const std::size_t at = layout_.at(0, j, k) + first, there = corrected ? inWindow(at) : at;
        const Row paths(*this, halfway, j, k);
        const float* own = pass.cells.cell(at);
        const Moving* moving = pass.moving + at;
        for (std::size_t i = 0; i < count; i += together)
            corners.find(i, began(paths.at(first + i), here(first + i, j, k), step, layout_));
        const FieldStrip::Reader field(corners);
        float* out = (corrected ? guesses() : pass.spare.data()) + there * lanes;
        for (std::size_t i = 0; i < count; ++i)
            storeRecord(out + i * lanes, chosen(moving[i], field.sample(i), load<Float8>(own + i * lanes)));
    };
    parallel::forEachBlock(
        static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock, [&](std::size_t first, std::size_t count) {
            FieldStrip strip(pass.field, layout_);
            for (std::size_t r = first; r < first + count; ++r)
                for (std::size_t i = 0; i < nx; i += stripCells)
                    predictStrip(i, std::min(stripCells, nx - i), layout_.rowJ(r), firstSlab + layout_.rowK(r), strip);
        });
}

/// The faces on the far sides do not move, and have no cells of their own.
void Advection::keepFarFaces(const Pass& pass, int firstSlab, int lastSlab) {
    const auto keep = [&](int i, int j, int k, std::size_t records) {
        const std::size_t at = layout_.at(i, j, k);
        std::memcpy(guesses() + inWindow(at) * lanes, pass.cells.cell(at), records * lanes * sizeof(float));
    };
    for (int k = firstSlab; k < lastSlab; ++k) {
        for (int j = 0; j < layout_.ny; ++j) keep(layout_.nx, j, k, 1);
        keep(-1, layout_.ny, k, layout_.row);
    }
    if (lastSlab == layout_.nz) keep(-1, -1, layout_.nz, layout_.slab);
}

/// c = ½(φⁿ − φ̃), limited, where φ̃ is the first guess sampled along the forward path; 0 where there is none.
void Advection::findCorrections(const Pass& pass, int firstSlab, int lastSlab) {
    const auto nx = static_cast<std::size_t>(layout_.nx), ny = static_cast<std::size_t>(layout_.ny);
    const float step = pass.step.cellsPerSpeed;
    struct Strip {
        ExtremaStrip began;
        WindowStrip ended;
        alignas(64) std::array<int, stripCells> within{};
    };
    const auto findInStrip = [&](std::size_t firstCell, std::size_t count, int j, int k, Strip& strip) {
        const std::size_t at = layout_.at(0, j, k) + firstCell, there = inWindow(at);
        const Row paths(*this, halfway, j, k), speeds(*this, centre, j, k);
        const Region region(layout_, k, pass.reach);
        strip.ended.lookFrom(region.lowestSlab());
        for (std::size_t i = 0; i < count; i += together) {
            const std::size_t cell = firstCell + i;
            PlacesOfCells places = began(paths.at(cell), here(cell, j, k), step, layout_);
            strip.began.find(i, places);
            const PlacesOfCells speed = speeds.at(cell);
            Int16 within{};
            for (std::size_t place = 0; place < places.size(); ++place)
                within |=
                    region.lead(places[place], moved(places[place], 2 * step, speed[place]), place) & (1 << place);
            store(&strip.within[i], within);
            strip.ended.find(i, places);
        }
        const WindowStrip::Reader ended(strip.ended);
        const ExtremaStrip::Reader field(strip.began);
        const Limit limit = pass.rule.limit;
        const Moving* moving = pass.moving + at;
        const float* own = pass.cells.cell(at);
        const float* guess = guesses() + there * lanes;
        float* out = pass.spare.cell(at);
        for (std::size_t i = 0; i < count; ++i, own += lanes, guess += lanes, out += lanes) {
            const auto first = load<Float8>(guess);
            const auto corrected = static_cast<Moving>(strip.within[i] & moving[i]);
            Float8 value = first;
            if (corrected != 0) {
                value += 0.5f * (load<Float8>(own) - ended.sample(i));
                if (limit != Limit::none) {
                    Float8 minimum, maximum;
                    field.extrema(i, minimum, maximum);
                    value = limit == Limit::clamp                       ? atMost(atLeast(value, minimum), maximum)
                            : ((value >= minimum) & (value <= maximum)) ? value
                                                                        : first;
                }
            }
            storeRecord(out, chosen(corrected, value - first, Float8{}));
        }
    };
    parallel::forEachBlock(static_cast<std::size_t>(lastSlab - firstSlab) * ny, rowsInABlock,
                           [&](std::size_t first, std::size_t count) {
                               Strip strip{ExtremaStrip(pass.field, layout_), WindowStrip(pass.window, layout_)};
                               for (std::size_t r = first; r < first + count; ++r) {
                                   const int j = layout_.rowJ(r), k = firstSlab + layout_.rowK(r);
                                   for (std::size_t i = 0; i < nx; i += stripCells)
                                       findInStrip(i, std::min(stripCells, nx - i), j, k, strip);
                                   mirrorRow(pass.spare, layout_, j, k);
                               }
                           });
}

void Advection::addCorrections(const Pass& pass, int firstSlab, int lastSlab) {
    parallel::forEachBlock(static_cast<std::size_t>(lastSlab - firstSlab) * static_cast<std::size_t>(layout_.ny),
                           rowsInABlock, [&](std::size_t first, std::size_t count) {
                               for (std::size_t r = first; r < first + count; ++r) {
                                   const int j = layout_.rowJ(r), k = firstSlab + layout_.rowK(r);
                                   const std::size_t at = layout_.at(0, j, k);
                                   addEvened(pass.spare, layout_, j, k, guesses() + inWindow(at) * lanes,
                                             pass.cells.cell(at));
                               }
                           });
}

void Advection::advect(CellField& cells, CellField& spare, const Moving* moving, AdvectionRule rule,
                       const AdvectionStep& step) {
    const int nz = layout_.nz;
    const auto slabs = static_cast<std::size_t>(nz) + 2;
    const double longest =
        std::min<double>(nz, std::ceil(static_cast<double>(step.maximumSpeeds.z * step.cellsPerSpeed)));
    const int reach = static_cast<int>(longest) + 2;
    const bool corrected = rule.scheme == AdvectionScheme::macCormack;
    hold(std::min(slabs, static_cast<std::size_t>(slabsAtATime + 2 * reach + 1)));
    centres_.hold(std::min(slabs, static_cast<std::size_t>(slabsAtATime + 2 * reach + 2)));
    const Extrapolation extrapolation{step.ahead, step.maximumSpeeds};
    const bool atMiddle = rule.velocityAt == VelocityAt::middle;
    const Pass pass{cells,
                    spare,
                    moving,
                    rule,
                    step,
                    reach,
                    {cells.data(), static_cast<int>(slabs)},
                    {window_.data(), static_cast<int>(heldSlabs_)}};
    // A slab is corrected as soon as all slabs that its paths can reach are available.
    // Its new state is written as soon as no path can reach its old one.
    int done = 0, centred = 0, complete = 0;
    for (int first = 0; first < nz; first += slabsAtATime) {
        const int last = std::min(first + slabsAtATime, nz), next = std::min(nz, last + reach);
        centres_.find(cells, atMiddle ? &extrapolation : nullptr, centred, next);
        centred = next;
        findPaths(pass, first, last);
        predict(pass, first, last);
        if (!corrected) continue;
        keepFarFaces(pass, first, last);
        const int ready = last == nz ? nz : std::max(done, last - reach);
        findCorrections(pass, done, ready);
        if (done == 0) mirrorSlab(spare, layout_, -1, 0);
        if (ready == nz) mirrorSlab(spare, layout_, nz, nz - 1);
        done = ready;
        const int free = last == nz ? nz : std::max(complete, ready - reach);
        addCorrections(pass, complete, free);
        complete = free;
    }
    if (!corrected) cells.swap(spare);
}

}  // namespace dustbench::grid_fluid::flow
