#include "methods/grid_fluid/trail_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/grid_fluid/trail/dust_trail.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid {
namespace {

/// A tile is omitted if no ray through it has more optical depth; so are the box's cells across its border.
constexpr double unseenDepth = 1e-4;
/// Light is computed for the uploaded densities; it is renewed when a tile has less than this share of them left.
constexpr double renewedShare = 0.95;
/// Cells within which the box fades out: two lattices then differ by an eighth of the difference at a sharp border.
constexpr int fadingCells = 8;
/// The box's identifier among the grids that cast shadows; no tile is there.
constexpr CloudShade::Id theBox{std::numeric_limits<int>::max(), 0, 0};

/// Layers of empty cells around a displayed grid. There are none below a floor, where the lowest cells continue.
struct Rim {
    Rim(raycast::Filter filter, bool onFloor) : before(filter == raycast::Filter::cubic ? 2 : 1), behind(before) {
        if (onFloor) before.y = 0;
    }
    [[nodiscard]] glm::ivec3 around(const glm::ivec3& cells) const { return cells + before + behind; }

    void surround(const glm::ivec3& cells, std::span<const float> values, std::vector<float>& to) const {
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
                const std::size_t from =
                    static_cast<std::size_t>(cells.x) *
                    (static_cast<std::size_t>(j) + static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(k));
                row = std::fill_n(row, before.x, 0.0f);
                row = std::copy_n(values.data() + from, cells.x, row);
                std::fill_n(row, behind.x, 0.0f);
            }
        });
    }

    glm::ivec3 before, behind;
};

}  // namespace

void CloudShade::set(const Id& id, const raycast::ShownGrid& grid) {
    blockMetres_ = grid.spacingMetres * block;
    Blocks& blocks = grids_[id];
    blocks.share = 1;
    blocks.count = (grid.cells + block - 1) / block;
    blocks.minimum = grid.originMetres;
    const auto index = [](const glm::ivec3& at, const glm::ivec3& size) {
        return static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
    };
    blocks.mean.assign(index({0, 0, blocks.count.z}, blocks.count), 0.0f);
    std::size_t cell = 0;
    for (int k = 0; k < grid.cells.z; ++k)
        for (int j = 0; j < grid.cells.y; ++j)
            for (int i = 0; i < grid.cells.x; ++i, ++cell)
                blocks.mean[index(glm::ivec3(i, j, k) / block, blocks.count)] += grid.density[cell];
    for (float& mean : blocks.mean) mean /= block * block * block;
}

void CloudShade::change(const Id& id, const glm::dvec3& originMetres, double share) {
    Blocks& blocks = grids_.at(id);
    blocks.minimum = originMetres;
    blocks.share = share;
}

float CloudShade::arrivingAt(const glm::dvec3& place, const Id& without) const {
    double depth = 0;
    for (const auto& [id, grid] : grids_) {
        if (id == without) continue;
        const glm::dvec3 maximum = grid.minimum + blockMetres_ * glm::dvec3(grid.count);
        double from = 0, to = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (grid.minimum[axis] - place[axis]) / toSun_[axis];
            const double b = (maximum[axis] - place[axis]) / toSun_[axis];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        for (double at = from; at < to; at += blockMetres_) {
            const double step = std::min(blockMetres_, to - at);
            const glm::dvec3 inBlocks = (place + (at + 0.5 * step) * toSun_ - grid.minimum) / blockMetres_;
            const glm::ivec3 in = glm::clamp(glm::ivec3(inBlocks), glm::ivec3(0), grid.count - 1);
            depth += step * grid.share *
                     static_cast<double>(
                         grid.mean[static_cast<std::size_t>(in.x + grid.count.x * (in.y + grid.count.y * in.z))]);
        }
    }
    return static_cast<float>(std::exp(-depth * extinction_));
}

TrailPicture::TrailPicture(raycast::GridRaycast& ofBox, const raycast::RaycastSettings& settings,
                           const glm::vec3& toSun, bool onFloor)
    : ofBox_(ofBox), settings_(settings), onFloor_(onFloor), shade_(toSun, settings.extinctionPerMetre) {}

bool TrailPicture::isSeen(const DustTrail::Tile& tile, double spacingMetres) const {
    return static_cast<double>(tile.maximum) * tile.share * settings_.extinctionPerMetre * spacingMetres *
               DustTrail::edge >
           unseenDepth;
}

void TrailPicture::show(const DustTrail& trail, const raycast::ShownGrid& box) {
    fadeBox(trail, box);
    const Rim rim(settings_.filter, onFloor_);
    rim.surround(box.cells, faded_, surrounded_);
    if (!box.reaction.empty()) rim.surround(box.cells, box.reaction, surroundedReaction_);
    const raycast::ShownGrid boxShown{rim.around(box.cells), box.spacingMetres,
                                      box.originMetres - box.spacingMetres * glm::dvec3(rim.before), surrounded_,
                                      surroundedReaction_};
    std::map<Place, const DustTrail::Tile*> seen;
    for (const auto& [place, values] : lent_) seen[place] = nullptr;
    for (const auto& [place, tile] : trail.tiles())
        if (isSeen(tile, trail.spacingMetres()) || seen.contains(place)) seen[place] = &tile;
    std::erase_if(tiles_, [&](const auto& entry) {
        const bool gone = !seen.contains(entry.first);
        if (gone) shade_.remove(entry.first);
        return gone;
    });
    raycast::ShownGrid grid;
    // All grids must cast their shadows before any is lit.
    if (isLit()) {
        shade_.set(theBox, boxShown);
        for (const auto& [place, tile] : seen) {
            if (find(trail, place, tile, grid))
                shade_.set(place, grid);
            else
                shade_.change(place, grid.originMetres, tile ? tile->share / tiles_[place].share : 1);
        }
    }
    for (const auto& [place, tile] : seen) {
        if (find(trail, place, tile, grid)) uploadTile(place, tile, grid);
        ShownTile& shown = tiles_[place];
        shown.picture->change(grid.originMetres, static_cast<float>(tile ? tile->share / shown.share : 1));
        shown.middle = trail.originOf(place) + 0.5 * trail.spacingMetres() * DustTrail::edge;
    }
    upload(ofBox_, theBox, boxShown);
}

void TrailPicture::upload(raycast::GridRaycast& picture, const Place& id, const raycast::ShownGrid& grid) {
    if (!isLit())
        picture.upload(grid);
    else
        picture.upload(grid, [&](const glm::dvec3& place) { return shade_.arrivingAt(place, id); });
}

/// From the box's border inwards, cells keep an increasing share of their density; the rest goes to the tiles' cells,
/// by overlapping volumes.
void TrailPicture::fadeBox(const DustTrail& trail, const raycast::ShownGrid& box) {
    const glm::ivec3 cells = box.cells;
    boxHalf_ = 0.5 * box.spacingMetres * glm::dvec3(cells);
    boxMiddle_ = box.originMetres + boxHalf_;
    faded_.assign(box.density.begin(), box.density.end());
    lent_.clear();
    const int depth = std::min(fadingCells, std::min({cells.x, cells.y, cells.z}) / 4);
    if (depth < 1) return;
    const auto least =
        static_cast<float>(unseenDepth / std::max(settings_.extinctionPerMetre * box.spacingMetres * 128, 1e-30));
    const glm::dvec3 corner = trail.inCells(box.originMetres);
    const Overlaps x(corner.x, corner.x + 1), y(corner.y, corner.y + 1), z(corner.z, corner.z + 1);
    const auto fromBorder = [&](int i, int count) { return std::min(i, count - 1 - i); };
    Place place{};
    std::vector<float>* tile = nullptr;
    const auto lend = [&](const glm::ivec3& cell, float density) {
        if (const Place of = DustTrail::tileOf(cell); !tile || of != place) {
            place = of;
            tile = &lent_[place];
            tile->resize(DustTrail::tileCells);
        }
        (*tile)[DustTrail::indexOf(cell, place)] += density;
    };
    const auto fade = [&](const glm::ivec3& cell, float& density) {
        if (density <= least) return;
        const int below = onFloor_ ? cells.y - 1 - cell.y : fromBorder(cell.y, cells.y);
        const int within = std::min({fromBorder(cell.x, cells.x), below, fromBorder(cell.z, cells.z)});
        const float kept = std::min((static_cast<float>(within) + 0.5f) / static_cast<float>(depth), 1.0f);
        const double rest = static_cast<double>(density * (1 - kept));
        if (rest <= 0) return;
        density *= kept;
        for (int k = 0; k < z.count; ++k)
            for (int j = 0; j < y.count; ++j)
                for (int i = 0; i < x.count; ++i)
                    lend({x.first + cell.x + i, y.first + cell.y + j, z.first + cell.z + k},
                         static_cast<float>(rest * x.shares[static_cast<std::size_t>(i)] *
                                            y.shares[static_cast<std::size_t>(j)] *
                                            z.shares[static_cast<std::size_t>(k)]));
    };
    float* row = faded_.data();
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j, row += cells.x) {
            const bool whole = fromBorder(k, cells.z) < depth || cells.y - 1 - j < depth || (!onFloor_ && j < depth);
            for (int i = 0; i < cells.x; ++i) {
                if (!whole && i == depth) i = std::max(i, cells.x - depth);
                fade({i, j, k}, row[i]);
            }
        }
}

bool TrailPicture::find(const DustTrail& trail, const Place& place, const DustTrail::Tile* tile,
                        raycast::ShownGrid& grid) {
    const ShownTile& shown = tiles_[place];
    const double spacing = trail.spacingMetres(), share = tile ? tile->share : 1;
    const Rim rim(settings_.filter, onFloor_ && place[1] == 0);
    const glm::ivec3 cells(DustTrail::edge);
    grid = {rim.around(cells), spacing, trail.originOf(place) - spacing * glm::dvec3(rim.before), {}, {}};
    const auto lent = lent_.find(place);
    const bool isLent = lent != lent_.end();
    if (shown.picture && !isLent && !shown.lent && shown.version == (tile ? tile->version : 0) &&
        !(isLit() && share < renewedShare * shown.share))
        return false;
    tileNow_.assign(DustTrail::tileCells, 0.0f);
    if (isLent) tileNow_ = lent->second;
    if (tile)
        std::ranges::transform(tile->density, tileNow_, tileNow_.begin(),
                               [&](float density, float more) { return density * static_cast<float>(share) + more; });
    rim.surround(cells, tileNow_, surroundedTile_);
    grid.density = surroundedTile_;
    return true;
}

void TrailPicture::uploadTile(const Place& place, const DustTrail::Tile* tile, const raycast::ShownGrid& grid) {
    ShownTile& shown = tiles_[place];
    if (!shown.picture) shown.picture = std::make_unique<raycast::GridRaycast>(raycast::Beside(), ofBox_);
    upload(*shown.picture, place, grid);
    shown.version = tile ? tile->version : 0;
    shown.share = tile ? tile->share : 1;
    shown.lent = lent_.contains(place);
}

void TrailPicture::draw(const scene::View& view, const gpu::Layer& layer) {
    const glm::dvec3 eye = view.camera.eye;
    // A tile is next to the box along the axis on which it is farthest from it. It is in front if the eye is on the
    // same side.
    const auto isInFront = [&](const ShownTile& tile) {
        const glm::dvec3 from = tile.middle - boxMiddle_, beyond = glm::abs(from) - boxHalf_;
        const int axis = beyond.x >= beyond.y && beyond.x >= beyond.z ? 0 : beyond.y >= beyond.z ? 1 : 2;
        return (eye[axis] - boxMiddle_[axis]) * (from[axis] > 0 ? 1 : -1) > boxHalf_[axis];
    };
    struct Drawn {
        bool inFront;
        double distance;
        raycast::GridRaycast* picture;
    };
    std::vector<Drawn> order{{true, std::numeric_limits<double>::infinity(), &ofBox_}};  // first of those in front
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
