#include "methods/grid_fluid/trail_picture.h"

#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid {
namespace {

/// A tile is left out if no ray through it meets more optical depth.
constexpr double unseenDepth = 1e-4;
/// Surfaces and light hold for the densities as uploaded: they are renewed when a tile has lost so much of them.
constexpr double renewedShare = 0.95;

}  // namespace

Rim::Rim(raycast::Filter filter, bool onFloor) : before(filter == raycast::Filter::cubic ? 2 : 1), behind(before) {
    if (onFloor) before.y = 0;
}

void Rim::surround(const glm::ivec3& cells, std::span<const float> values, float share, std::vector<float>& to) const {
    const glm::ivec3 size = around(cells);
    const auto rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    to.resize(rows * static_cast<std::size_t>(size.x));
    parallel::forEachBlock(rows, 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            float* row = to.data() + r * static_cast<std::size_t>(size.x);
            const int j = static_cast<int>(r) % size.y - before.y, k = static_cast<int>(r) / size.y - before.z;
            if (j < 0 || j >= cells.y || k < 0 || k >= cells.z) {
                std::fill_n(row, size.x, 0.0f);
                continue;
            }
            const float* from = values.data() + static_cast<std::size_t>(cells.x) *
                                                    (static_cast<std::size_t>(j) +
                                                     static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(k));
            row = std::fill_n(row, before.x, 0.0f);
            row = std::transform(from, from + cells.x, row, [&](float value) { return value * share; });
            std::fill_n(row, behind.x, 0.0f);
        }
    });
}

TrailPicture::TrailPicture(const raycast::GridRaycast& ofBox, const raycast::RaycastSettings& settings, bool onFloor)
    : ofBox_(ofBox), settings_(settings), onFloor_(onFloor) {}

Rim TrailPicture::rimOf(const Place& place) const {
    return {settings_.filter, onFloor_ && place[1] == 0};
}

bool TrailPicture::isSeen(const DustTrail::Tile& tile, double spacingMetres) const {
    return static_cast<double>(tile.maximum) * tile.share * settings_.extinctionPerMetre * spacingMetres *
               DustTrail::edge >
           unseenDepth;
}

void TrailPicture::show(const DustTrail& trail) {
    std::erase_if(tiles_, [&](const auto& entry) {
        const auto found = trail.tiles().find(entry.first);
        return found == trail.tiles().end() || !isSeen(found->second, trail.spacingMetres());
    });
    for (const auto& [place, tile] : trail.tiles())
        if (isSeen(tile, trail.spacingMetres())) showTile(trail, place, tile);
}

void TrailPicture::showTile(const DustTrail& trail, const Place& place, const DustTrail::Tile& tile) {
    ShownTile& shown = tiles_[place];
    if (!shown.picture) shown.picture = std::make_unique<raycast::GridRaycast>(raycast::Beside(), ofBox_);
    const double spacing = trail.spacingMetres();
    const glm::dvec3 origin = trail.originOf(place);
    const Rim rim = rimOf(place);
    const glm::dvec3 originWithRim = origin - spacing * glm::dvec3(rim.before);
    const bool holdsAsUploaded = settings_.shadowCells > 0 || settings_.renderer == raycast::Renderer::isosurface;
    if (shown.version != tile.version || (holdsAsUploaded && tile.share < renewedShare * shown.share)) {
        const glm::ivec3 cells(DustTrail::edge);
        rim.surround(cells, tile.density, static_cast<float>(tile.share), surrounded_);
        shown.picture->upload({rim.around(cells), spacing, originWithRim, surrounded_, {}});
        shown.version = tile.version;
        shown.share = tile.share;
    }
    shown.picture->change(originWithRim, static_cast<float>(tile.share / shown.share));
    shown.middle = origin + 0.5 * spacing * DustTrail::edge;
}

void TrailPicture::draw(const scene::View& view, const gpu::Layer& layer, raycast::GridRaycast& ofBox,
                        const flow::FluidBox& box) {
    const glm::dvec3 eye = view.camera.eye;
    const glm::dvec3 half = 0.5 * box.spacingMetres * glm::dvec3(box.cells), middle = box.originMetres + half;
    // A tile lies beside the box along the axis on which it is furthest from it. It is in front if the eye is there
    // too.
    const auto isInFront = [&](const ShownTile& tile) {
        const glm::dvec3 from = tile.middle - middle, beyond = glm::abs(from) - half;
        const int axis = beyond.x >= beyond.y && beyond.x >= beyond.z ? 0 : beyond.y >= beyond.z ? 1 : 2;
        return (eye[axis] - middle[axis]) * (from[axis] > 0 ? 1 : -1) > half[axis];
    };
    struct Drawn {
        bool inFront;
        double distance;
        raycast::GridRaycast* picture;
    };
    std::vector<Drawn> order{{true, std::numeric_limits<double>::infinity(), &ofBox}};  // first of those in front
    for (const auto& [place, tile] : tiles_)
        order.push_back({isInFront(tile), glm::distance(tile.middle, eye), tile.picture.get()});
    std::ranges::stable_sort(order, [](const Drawn& a, const Drawn& b) {
        return a.inFront != b.inFront ? b.inFront : a.distance > b.distance;
    });
    raycast::SceneDepthCopy sceneDepth(layer);
    primitives_ = 0;
    for (const Drawn& each : order) {
        each.picture->draw(view, layer, sceneDepth);
        primitives_ += each.picture->primitives();
    }
}

std::size_t TrailPicture::gpuBytes() const {
    std::size_t bytes = 0;
    for (const auto& [place, tile] : tiles_) bytes += tile.picture->gpuBytes();
    return bytes;
}

}  // namespace dustbench::grid_fluid
