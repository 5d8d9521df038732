#include "methods/kit/raycast/cpu_march.h"

#include "methods/kit/raycast/packet_march.h"

namespace dustbench::raycast {
namespace {

/// Evaluates a cubic B-spline with eight linear samples instead of 64 cells, by merging the weights along each axis
/// into two pairs. Source: Sigg2005.
struct CubicPairs {
    explicit CubicPairs(const Floats& place) {
        const Floats low = toFloats(wholePart(place + 1)) - 1;  // positions are −½ or more
        const Floats share = place - low, rest = 1 - share;
        const Floats w0 = rest * rest * rest * (1.0f / 6), w3 = share * share * share * (1.0f / 6);
        const Floats w1 = 2.0f / 3 - 0.5f * share * share * (2 - share), w2 = 1 - w0 - w1 - w3;
        weightBelow = w0 + w1;
        below = low - 1 + w1 / weightBelow;
        above = low + 1 + w3 / (w2 + w3);
    }
    Floats weightBelow, below, above;
};

Floats sampleCubic(const PaddedCells& cells, const Places& at) {
    const CubicPairs x(at.x), y(at.y), z(at.z);
    const Places above{1 - x.weightBelow, 1 - y.weightBelow, 1 - z.weightBelow};
    return betweenEight(above, [&](int corner) {
        return sampleAnywhere(
            cells, {corner & 1 ? x.above : x.below, corner & 2 ? y.above : y.below, corner & 4 ? z.above : z.below});
    });
}

/// The values of the cells at positions relative to the centre of the first cell.
Floats sampleNearest(const PaddedCells& cells, const Places& at) {
    const auto cellOf = [](const Floats& place, int count) {
        return wholePart(atLeast(atMost(place + 0.5f, all(static_cast<float>(count - 1))), all(0)));
    };
    const Ints index = cellOf(at.x, cells.cells().x) + cells.row() * cellOf(at.y, cells.cells().y) +
                       cells.slab() * cellOf(at.z, cells.cells().z);
    const float* const origin = cells.origin();
    Floats values;
    for (int lane = 0; lane < laneCount; ++lane) values[lane] = origin[index[lane]];
    return values;
}

/// True if any brick that a box of cells touches is occupied.
bool anyOccupied(const BrickMap& bricks, const Four& low, const Four& high) {
    constexpr float perCell = 1.0f / BrickMap::edge;
    const FourInts none{}, end{bricks.bricks().x - 1, bricks.bricks().y - 1, bricks.bricks().z - 1, 0};
    const FourInts first = atLeast(atMost(__builtin_convertvector(low * perCell, FourInts), end), none);
    const FourInts last = atLeast(atMost(__builtin_convertvector(high * perCell, FourInts), end), none);
    for (int z = first[2]; z <= last[2]; ++z)
        for (int y = first[1]; y <= last[1]; ++y)
            for (int x = first[0]; x <= last[0]; ++x)
                if (bricks.at(x, y, z)) return true;
    return false;
}

/// A probe of a dense grid for a packet of rays.
struct Grid {
    Field density;
    std::optional<Field> reaction;  ///< empty: no fire
    const BrickMap* bricks;         ///< null: no skipping
};

template <Filter filter>
class DenseProbe {
 public:
    DenseProbe(const Grid& grid, const RayPacket& rays) : grid_(grid), rays_(rays) {}

    [[gnu::always_inline]] [[nodiscard]] Floats density(const Reach& reach) const {
        return sample(grid_.density, reach);
    }
    [[gnu::always_inline]] [[nodiscard]] Floats reaction(const Reach& reach) const {
        return sample(*grid_.reaction, reach);
    }
    [[gnu::always_inline]] [[nodiscard]] int clearChunks(float, float nearest, float farthest) const {
        return anyOccupied(*grid_.bricks, rays_.low(nearest, farthest), rays_.high(nearest, farthest)) ? 0 : 1;
    }

 private:
    [[gnu::always_inline]] [[nodiscard]] Floats sample(const Field& field, const Reach& reach) const {
        if constexpr (filter == Filter::linear)
            return sampleLinear(field, rays_, reach, 1);
        else
            return (filter == Filter::cubic ? sampleCubic : sampleNearest)(field.cells,
                                                                           placesOf(rays_, reach.middle, Four{}, 1));
    }

    const Grid& grid_;
    const RayPacket& rays_;
};

}  // namespace

CpuMarch::CpuMarch(const RaycastSettings& settings, MemoryLedger& ledger)
    : settings_(settings),
      fire_(settings.fire.table()),
      density_(ledger.account("ray cast density")),
      reaction_(ledger.account("ray cast reaction")) {}

void CpuMarch::upload(const ShownGrid& grid, const BrickMap& bricks, const LightVolume* light) {
    density_.set(grid.cells, grid.density);
    burning_ = !grid.reaction.empty();
    if (burning_) reaction_.set(grid.cells, grid.reaction);
    extinctionPerCell_ = static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres);
    bricks_ = &bricks;
    light_ = light;
}

void CpuMarch::march(const PixelRays& rays, const SceneDepths& depths, const Reflected& reflected,
                     const PacketPicture& picture, float thickness) const {
    const BrickMap* const bricks = settings_.skipEmpty ? bricks_ : nullptr;
    Grid grid{Field(density_), std::nullopt, bricks};
    if (burning_) grid.reaction.emplace(reaction_);
    Medium medium{density_.cells(),
                  bricks != nullptr,
                  bricks_->minimum(),
                  bricks_->maximum(),
                  burning_,
                  std::nullopt,
                  fire_,
                  reflected,
                  static_cast<float>(settings_.stepCells),
                  extinctionPerCell_ * thickness,
                  opaqueDepth(settings_)};
    if (light_) medium.light.emplace(light_->padded(), 1 / static_cast<float>(light_->texelCells()));
    const auto by = [&]<Filter filter>() {
        const auto all = channels() == 4 ? marchPackets<DenseProbe<filter>, true, Grid>
                                         : marchPackets<DenseProbe<filter>, false, Grid>;
        all(medium, grid, rays, depths, settings_.jitter, picture);
    };
    switch (settings_.filter) {
        case Filter::nearest:
            return by.operator()<Filter::nearest>();
        case Filter::linear:
            return by.operator()<Filter::linear>();
        case Filter::cubic:
            return by.operator()<Filter::cubic>();
    }
}

}  // namespace dustbench::raycast
