#include "methods/grid_fluid/flow/advection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "methods/grid_fluid/flow/evened_corrections.h"
#include "methods/grid_fluid/flow/sampling.h"
#include "methods/grid_fluid/flow/sixteen_records.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr std::size_t blocksOfSlab = 8, maximumRows = 8;  ///< rows of a block; fewer in a flat box
constexpr std::size_t cellsAtOnce = SixteenRecords::count;
using FieldStrip = CornerStrip<Memory::whole, Reads::samples>;
using ExtremaStrip = CornerStrip<Memory::whole, Reads::extrema>;
using WindowStrip = CornerStrip<Memory::ring, Reads::samples>;
/// Cells by which a path may leave the region, since speeds across a wall are rounding errors next to it.
constexpr float tolerance = pathTolerance;

/// Writes two extra lanes, which the next record of the row, or its ghost, will overwrite.
[[gnu::always_inline]] inline void storeRecord(float* record, const Float8& value) {
    store(record, value);
}

void storeFirst(float* to, const Float16& values, std::size_t count) {
    if (count >= cellsAtOnce)
        store(to, values);
    else
        std::memcpy(to, &values, count * sizeof(float));
}

/// Sixteen vectors of four floats by component, without the fourth.
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

constexpr Float16 laneIndices{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

using Int8 = int __attribute__((vector_size(32)));

/// Takes the quantities that move from `value`, the others from `own`.
[[gnu::always_inline]] inline Float8 chosen(Moving moving, const Float8& value, const Float8& own) {
    constexpr Int8 bits{1, 2, 4, 8, 8, 8, 8, 8};
    return ((Int8{} + moving) & bits) != 0 ? value : own;
}

[[gnu::always_inline]] inline bool moves(Moving moving, std::size_t lane) {
    return (moving >> lane & 1) != 0;
}

/// The corrected value, limited by the extrema around the departure point.
template <Limit limit, typename Number>
[[gnu::always_inline]] inline Number limited(const Number& value, const Number& first, const Number& minimum,
                                             const Number& maximum) {
    if constexpr (limit == Limit::clamp) return atMost(atLeast(value, minimum), maximum);
    if constexpr (limit == Limit::revert) return ((value >= minimum) & (value <= maximum)) ? value : first;
    return value;
}

/// The places of sixteen cells of a row, and of their faces.
[[gnu::always_inline]] inline Triples placesOf(std::size_t cell, int j, int k) {
    return {static_cast<float>(cell + 1) + laneIndices, everywhere<Float16>(static_cast<float>(j + 1)),
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

/// The region in which a path must stay to be corrected: between the places that move, and no farther along z than the
/// maximum speed.
class Region {
 public:
    Region(const CellLayout& layout, int k, int reach) : high_{layout.nx, layout.ny, layout.nz} {
        lowestZ_ = std::max(1, k + 1 - (reach - 1));
        highestZ_ = k + 1 + (reach - 1);
    }
    [[nodiscard]] int lowestSlab() const { return lowestZ_; }
    /// Moves sixteen places to the ends of their paths, limited to the region. Returns -1 where both ends are within.
    [[gnu::always_inline]] Int16 lead(Triples& place, const Triples& end, std::size_t kind) const {
        Int16 within = Int16{} - 1;
        const auto along = [&](Float16& from, const Float16& to, int low, int high) {
            const auto minimum = everywhere<Float16>(static_cast<float>(low));
            const auto maximum = everywhere<Float16>(static_cast<float>(high));
            const auto isWithin = [&](const Float16& at) {
                return (at >= minimum - tolerance) & (at <= maximum + tolerance);
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

/// The lag of each stage in slabs behind the first one, the velocities at the centres, and the number of slabs stored
/// for each. In each round, every stage processes a different slab. Its input was computed in an earlier round and is
/// still stored, and no stage reads the state where another one replaces it.
struct Advection::Stagger {
    Stagger(int nz, double cellsAlongZ) {
        const int longest = static_cast<int>(std::min<double>(nz, std::ceil(cellsAlongZ)));
        reach = longest + 2;
        reachHalfway = (longest + 1) / 2 + 2;
        paths = reachHalfway + 1;
        guesses = paths + 1;
        corrections = guesses + reach + 1;
        results = corrections + reach + 1;
        const auto held = [&](int slabs) { return static_cast<std::size_t>(std::min(nz + 2, slabs)); };
        // From the farthest slab ahead that a round writes, including ghosts, to the farthest behind that it reads.
        heldCentres = held(paths + reachHalfway + 2);
        heldPaths = held(corrections - paths + 2);
        heldGuesses = held(results - guesses + 2);
    }
    int reach, reachHalfway;  ///< slabs on either side that samples of a path, or of half a path, may touch
    int paths, guesses, corrections, results;
    std::size_t heldCentres, heldPaths, heldGuesses;
};

struct Advection::Pass {
    CellField& cells;
    CellField& spare;  ///< the result of the semi-Lagrangian scheme, or MacCormack's corrections
    const Moving* moving;
    AdvectionRule rule;
    AdvectionStep step;
    Stagger stagger;
    RecordView field, window;
};

/// Velocities of a row in the window, at its cells and faces.
class Advection::Row {
 public:
    Row(Advection& of, Kept array, int j, int k) {
        const CellLayout& layout = of.layout_;
        const std::size_t at = of.inPaths(layout.at(0, j, k)), slabBefore = of.inPaths(layout.at(0, j, k - 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float* all = of.velocities(array + axis);
            own_[axis] = all + at;
            below_[axis] = all + at - layout.row;
            before_[axis] = all + slabBefore;
        }
    }
    /// A face has the mean velocity of its two cells.
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

void Advection::hold(const Stagger& stagger) {
    heldGuesses_ = stagger.heldGuesses;
    heldPaths_ = stagger.heldPaths;
    const std::size_t floats = (lanes * heldGuesses_ + kept * heldPaths_) * layout_.slab + 2 * CellField::floatsBehind;
    if (window_.size() < floats) window_.resize(floats);
    centres_.hold(stagger.heldCentres);
}

/// The velocity half-way along the path of a cell, u(x − ½Δt·u(x)).
void Advection::findPathsOfRow(const Pass& pass, int j, int k) {
    const auto nx = static_cast<std::size_t>(layout_.nx);
    const std::size_t at = inPaths(layout_.at(0, j, k));
    const float* centres = centres_.slab(k) + layout_.at(0, j, -1) * 4;
    CentreStrip strip(centres_.data(), static_cast<int>(centres_.slabs()), layout_);
    strip.lookFrom(std::max(k + 1 - pass.stagger.reachHalfway, 0));
    alignas(64) std::array<float, 4 * cellsAtOnce> found;
    for (std::size_t i = 0; i < nx; i += cellsAtOnce) {
        const std::size_t count = nx - i;
        const Triples speed = byComponent(centres + 4 * i);
        const auto back = [&](const Float16& place, const Float16& velocity, int cells) {
            const Float16 middle = fused(everywhere<Float16>(-0.5f * pass.step.cellsPerSpeed), velocity, place);
            return atMost(atLeast(middle, Float16{}), everywhere<Float16>(static_cast<float>(cells + 1)));
        };
        strip.find({back(static_cast<float>(i + 1) + laneIndices, speed.x, layout_.nx),
                    back(everywhere<Float16>(static_cast<float>(j + 1)), speed.y, layout_.ny),
                    back(everywhere<Float16>(static_cast<float>(k + 1)), speed.z, layout_.nz)});
        for (std::size_t c = 0; c < std::min(count, cellsAtOnce); ++c) store(&found[4 * c], strip.sample(c));
        const Triples middle = byComponent(found.data());
        const std::array<const Float16*, kept> all{&speed.x, &speed.y, &speed.z, &middle.x, &middle.y, &middle.z};
        for (std::size_t array = 0; array < kept; ++array) storeFirst(velocities(array) + at + i, *all[array], count);
    }
    // Faces on the sides towards −x, −y and −z have no other cell in the box.
    const std::size_t rowBytes = layout_.row * sizeof(float), sideY = inPaths(layout_.at(-1, -1, k)),
                      sideZ = inPaths(layout_.at(-1, j, -1));
    for (std::size_t array = 0; array < kept; ++array) {
        float* row = velocities(array) + at - 1;
        row[0] = row[1];
        if (j == 0) std::memcpy(velocities(array) + sideY, row, rowBytes);
        if (k == 0) std::memcpy(velocities(array) + sideZ, row, rowBytes);
    }
}

void Advection::findPaths(const Pass& pass, const Rows& rows) {
    for (int j = rows.first; j < rows.end; ++j) findPathsOfRow(pass, j, rows.k);
}

/// The first guess: the sample at the beginning of each path, x₋ = x − Δt·u.
void Advection::predict(const Pass& pass, const Rows& rows) {
    const bool corrected = pass.rule.scheme == AdvectionScheme::macCormack;
    const auto nx = static_cast<std::size_t>(layout_.nx);
    const float step = pass.step.cellsPerSpeed;
    FieldStrip corners(pass.field, layout_);
    const auto predictStrip = [&](std::size_t first, std::size_t count, int j) {
        const std::size_t at = layout_.at(0, j, rows.k) + first;
        const Row paths(*this, halfway, j, rows.k);
        const float* own = pass.cells.cell(at);
        const Moving* moving = pass.moving + at;
        for (std::size_t i = 0; i < count; i += cellsAtOnce)
            corners.find(i, began(paths.at(first + i), placesOf(first + i, j, rows.k), step, layout_), count);
        const FieldStrip::Reader field(corners);
        float* out = corrected ? guess(at) : pass.spare.cell(at);
        for (std::size_t i = 0; i < count; ++i)
            storeRecord(out + i * lanes, chosen(moving[i], field.sample(i), load<Float8>(own + i * lanes)));
        field.forElsewhere([&](Elsewhere e) {
            if (moves(moving[e.i], e.lane)) out[e.i * lanes + e.lane] = field.sample(e);
        });
    };
    for (int j = rows.first; j < rows.end; ++j) {
        for (std::size_t i = 0; i < nx; i += stripCells) predictStrip(i, std::min(stripCells, nx - i), j);
        if (corrected) keepFarFaces(pass, j, rows.k);
    }
}

/// The faces on the far sides do not move and do not belong to any cell.
void Advection::keepFarFaces(const Pass& pass, int j, int k) {
    const auto keep = [&](int i, int y, int z, std::size_t records) {
        const std::size_t at = layout_.at(i, y, z);
        std::memcpy(guess(at), pass.cells.cell(at), records * lanes * sizeof(float));
    };
    keep(layout_.nx, j, k, 1);
    if (j + 1 == layout_.ny) keep(-1, layout_.ny, k, layout_.row);
    if (k + 1 == layout_.nz) keep(-1, j, layout_.nz, layout_.row);
    if (j + 1 == layout_.ny && k + 1 == layout_.nz) keep(-1, layout_.ny, layout_.nz, layout_.row);
}

/// c = ½(φⁿ − φ̃), limited, where φ̃ is the first guess sampled along the forward path; 0 where there is none.
template <Limit limit>
void Advection::findCorrections(const Pass& pass, const Rows& rows) {
    const int k = rows.k;
    const auto nx = static_cast<std::size_t>(layout_.nx);
    const float step = pass.step.cellsPerSpeed;
    const Region region(layout_, k, pass.stagger.reach);
    ExtremaStrip beginnings(pass.field, layout_);
    WindowStrip ends(pass.window, layout_);
    ends.lookFrom(region.lowestSlab());
    alignas(64) std::array<int, stripCells> isWithin{};
    alignas(64) std::array<float, 8 * stripCells> corrections;
    const auto correctStrip = [&](std::size_t firstCell, std::size_t count, int j) {
        const std::size_t at = layout_.at(0, j, k) + firstCell;
        const Row paths(*this, halfway, j, k), speeds(*this, centre, j, k);
        for (std::size_t i = 0; i < count; i += cellsAtOnce) {
            const std::size_t cell = firstCell + i;
            PlacesOfCells places = began(paths.at(cell), placesOf(cell, j, k), step, layout_);
            beginnings.find(i, places, count);
            const PlacesOfCells speed = speeds.at(cell);
            Int16 within{};
            for (std::size_t place = 0; place < places.size(); ++place)
                within |=
                    region.lead(places[place], moved(places[place], 2 * step, speed[place]), place) & (1 << place);
            store(&isWithin[i], within);
            ends.find(i, places, count);
        }
        const float* own = pass.cells.cell(at);
        const WindowStrip::Reader ended(ends);
        for (std::size_t i = 0; i < count; ++i)
            store(&corrections[8 * i], 0.5f * (load<Float8>(own + i * lanes) - ended.sample(i)));
        ended.forElsewhere(
            [&](Elsewhere e) { corrections[8 * e.i + e.lane] = 0.5f * (own[e.i * lanes + e.lane] - ended.sample(e)); });
        const ExtremaStrip::Reader field(beginnings);
        const Moving* moving = pass.moving + at;
        const float* guessed = guess(at);
        float* out = pass.spare.cell(at);
        const auto corrected = [&](std::size_t i) { return static_cast<Moving>(isWithin[i] & moving[i]); };
        for (std::size_t i = 0; i < count; ++i) {
            const auto first = load<Float8>(guessed + i * lanes);
            Float8 minimum{}, maximum{};
            if constexpr (limit != Limit::none) field.extrema(i, minimum, maximum);
            const Float8 value = limited<limit>(first + load<Float8>(&corrections[8 * i]), first, minimum, maximum);
            storeRecord(out + i * lanes, chosen(corrected(i), value - first, Float8{}));
        }
        if constexpr (limit == Limit::none) return;
        field.forElsewhere([&](Elsewhere e) {
            const float first = guessed[e.i * lanes + e.lane];
            float minimum, maximum;
            field.extrema(e, minimum, maximum);
            const float value = limited<limit>(first + corrections[8 * e.i + e.lane], first, minimum, maximum);
            if (moves(corrected(e.i), e.lane)) out[e.i * lanes + e.lane] = value - first;
        });
    };
    for (int j = rows.first; j < rows.end; ++j) {
        for (std::size_t i = 0; i < nx; i += stripCells) correctStrip(i, std::min(stripCells, nx - i), j);
        mirrorRow(pass.spare, layout_, j, k);
    }
}

void Advection::addCorrections(const Pass& pass, const Rows& rows) {
    for (int j = rows.first; j < rows.end; ++j) {
        const std::size_t at = layout_.at(0, j, rows.k);
        addEvened(pass.spare, layout_, j, rows.k, guess(at), pass.cells.cell(at));
    }
}

void Advection::advect(CellField& cells, CellField& spare, const Moving* moving, AdvectionRule rule,
                       const AdvectionStep& step) {
    const int nz = layout_.nz;
    const Stagger stagger(nz, static_cast<double>(step.maximumSpeeds.z * step.cellsPerSpeed));
    const bool corrected = rule.scheme == AdvectionScheme::macCormack;
    const bool atMiddle = rule.velocityAt == VelocityAt::middle;
    hold(stagger);
    if (atMiddle) centres_.keepLast();
    const Extrapolation toMiddle{step.ahead, step.maximumSpeeds};
    const Extrapolation* extrapolation = atMiddle ? &toMiddle : nullptr;
    const Pass pass{cells,
                    spare,
                    moving,
                    rule,
                    step,
                    stagger,
                    {cells.data(), nz + 2},
                    {window_.data(), static_cast<int>(heldGuesses_)}};
    const int turns = nz + (corrected ? stagger.results : stagger.guesses);
    const auto ny = static_cast<std::size_t>(layout_.ny);
    const std::size_t rowsInABlock = std::clamp<std::size_t>(ny / blocksOfSlab, 1, maximumRows);
    for (int turn = 0; turn < turns; ++turn)
        parallel::forEachBlock(ny, rowsInABlock, [&](std::size_t first, std::size_t count) {
            const auto stage = [&](int behind, const auto& work) {
                const Rows rows{turn - behind, static_cast<int>(first), static_cast<int>(first + count)};
                if (rows.k >= 0 && rows.k < nz) work(rows);
            };
            stage(0, [&](const Rows& rows) {
                for (int j = rows.first; j < rows.end; ++j) centres_.findRow(cells, extrapolation, j, rows.k);
            });
            stage(stagger.paths, [&](const Rows& rows) { findPaths(pass, rows); });
            stage(stagger.guesses, [&](const Rows& rows) { predict(pass, rows); });
            if (!corrected) return;
            stage(stagger.corrections, [&](const Rows& rows) {
                switch (rule.limit) {
                    case Limit::clamp:
                        return findCorrections<Limit::clamp>(pass, rows);
                    case Limit::revert:
                        return findCorrections<Limit::revert>(pass, rows);
                    case Limit::none:
                        return findCorrections<Limit::none>(pass, rows);
                }
            });
            stage(stagger.results, [&](const Rows& rows) { addCorrections(pass, rows); });
        });
    if (!corrected) cells.swap(spare);
}

}  // namespace dustbench::grid_fluid::flow
