#include "methods/volume/sparse/sparse_series.h"

#include <algorithm>
#include <limits>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/volumes/file_series.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {
namespace {

constexpr std::size_t leavesPerBlock = 64;

/// Calls see(brick) for the bricks that samples with density read; maybe more than once for a brick.
template <typename See>
void forEachSeen(const NanoTree& densities, const See& see) {
    for (const TreeBrick& brick : densities.bricks())
        for (int n = 0; n < 8; ++n)
            if (touchesAbove(brick.active, n)) see(brick.at + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
}

void place(SparseMoment& moment, const volumes::GridPlace& place, const glm::ivec3& firstCell) {
    moment.cells = place.cells;
    moment.spacingMetres = place.spacing;
    moment.originMetres = place.origin;
    moment.firstCell = firstCell;
}

glm::dvec3 latticeOrigin(const SparseMoment& moment) {
    return moment.originMetres - moment.spacingMetres * glm::dvec3(moment.firstCell);
}

}  // namespace

SparseSeries::SparseSeries(const volumes::VolumeSetup& setup, MemoryLedger& ledger)
    : setup_(setup), ledger_(ledger), between_(ledger, "moment shown") {
    std::vector<volumes::GridPlace> places;
    readDensities(places);
    series_.emplace(places, names_, setup.secondsPerFile, files::limits::sparseVolumeCells);
    if (setup.fire.empty()) return;
    readTemperatures(series_->places());
    if (!isStill()) return;
    NanoTree& reaction = moments_.front().reaction;
    for (std::size_t leaf = 0; leaf < reaction.leafCount(); ++leaf)
        for (float& value : std::span(reaction.valuesOf(leaf), brickCells)) value = freshness(value);
}

float SparseSeries::freshness(float temperature) const {
    const auto cold = static_cast<float>(setup_.coldTemperature);
    const float range = static_cast<float>(setup_.hotTemperature) - cold;
    return std::clamp((temperature - cold) / range, 0.0f, 1.0f);
}

std::size_t SparseSeries::roomBytes() const {
    std::size_t taken = 0;
    for (const SparseMoment& moment : moments_) taken += moment.density.bytes().size() + moment.reaction.bytes().size();
    return static_cast<std::size_t>(files::limits::dustBytes) - taken;
}

void SparseSeries::readDensities(std::vector<volumes::GridPlace>& places) {
    for (const volumes::SeriesEntry& entry : volumes::seriesEntries(setup_.files, "volumes")) {
        files::noteInput(entry.file);
        BrickReader reader(entry.file, setup_, places.empty() ? nullptr : &places.front());
        reader.readDensities();
        SparseMoment& moment = moments_.emplace_back(ledger_, "files");
        place(moment, reader.place(), reader.firstCell());
        plantDensities(reader.bricks(), moment.spacingMetres, latticeOrigin(moment), roomBytes(), moment.density);
        places.push_back(reader.place());
        if (entry.timeSeconds) places.back().timeSeconds = entry.timeSeconds;
        names_.push_back(entry.file);
    }
}

/// A moment's temperatures are kept where it or a neighbouring moment has density, since both count between two
/// moments.
void SparseSeries::readTemperatures(const std::vector<volumes::GridPlace>& places) {
    for (std::size_t i = 0; i < moments_.size(); ++i) {
        BrickRows rows;
        for (std::size_t adjacent = i > 0 ? i - 1 : 0; adjacent < std::min(i + 2, moments_.size()); ++adjacent)
            forEachSeen(moments_[adjacent].density, [&](const glm::ivec3& brick) { rows.add(brick); });
        rows.close();
        BrickReader reader(names_[i], setup_, &places.front());
        reader.readTemperatures(rows);
        if (reader.place().cells != places[i].cells || reader.place().origin != places[i].origin)
            throw InputError(names_[i].string() + ": it changed while it was read");
        SparseMoment& moment = moments_[i];
        plantAll(reader.bricks(), moment.spacingMetres, latticeOrigin(moment), roomBytes(), moment.reaction);
    }
}

SparseSeries::Sources SparseSeries::join(const NanoTree& before, const NanoTree& after,
                                         const std::vector<TreeBrick>& others, NanoTree& joined) const {
    std::vector<TreeBrick> bricks = before.bricks();
    std::unordered_map<std::uint64_t, std::size_t> places;
    places.reserve(2 * bricks.size());
    for (std::size_t i = 0; i < bricks.size(); ++i) places.emplace(keyOf(bricks[i].at), i);
    Sources found(bricks.size());
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        if (bricks[i].isLeaf) found[i][0] = before.valuesOf(bricks[i].source);
        bricks[i].source = i;
    }
    const auto add = [&](const TreeBrick& brick) -> std::size_t {
        const auto [at, isNew] = places.emplace(keyOf(brick.at), bricks.size());
        if (isNew) {
            bricks.push_back({brick.at, false, {}, bricks.size()});
            found.emplace_back();
        }
        TreeBrick& own = bricks[at->second];
        own.isLeaf |= brick.isLeaf;
        for (std::size_t x = 0; x < own.active.size(); ++x) own.active[x] |= brick.active[x];
        return at->second;
    };
    for (const TreeBrick& brick : after.bricks()) {
        const std::size_t at = add(brick);
        if (brick.isLeaf) found[at][1] = after.valuesOf(brick.source);
    }
    for (const TreeBrick& brick : others) (void)add(brick);
    const SparseMoment& lead = moments_.front();
    joined.lay(bricks, lead.spacingMetres, latticeOrigin(lead), std::numeric_limits<std::size_t>::max());
    Sources sources;
    for (const TreeBrick& brick : bricks)
        if (brick.isLeaf) sources.push_back(found[brick.source]);
    return sources;
}

void SparseSeries::prepare(std::size_t before, std::size_t after) {
    if (joined_ == std::pair(before, after)) return;
    const volumes::GridPlace both = volumes::enclosing(series_->places()[before], series_->places()[after]);
    place(between_, both, volumes::firstCell(series_->places().front(), both) + leadCell);
    densities_ = join(moments_[before].density, moments_[after].density, {}, between_.density);
    if (!setup_.fire.empty()) {
        // Outside the boxes of both moments, but in the box around both, the temperature is 0, which may be warm.
        std::vector<TreeBrick> beyond;
        if (freshness(0) > 0)
            forEachSeen(between_.density, [&](const glm::ivec3& brick) { beyond.push_back({brick, true, {}, 0}); });
        temperatures_ = join(moments_[before].reaction, moments_[after].reaction, beyond, between_.reaction);
    }
    joined_ = {before, after};
}

const SparseMoment& SparseSeries::at(double seconds) {
    const volumes::Between now = series_->at(seconds);
    const bool isMoment = now.share == 0 && (isStill() || setup_.fire.empty());
    if (!shown_ || shown_->before != now.before || shown_->after != now.after || shown_->share != now.share) {
        ++shows_;
        if (!isMoment) {
            prepare(now.before, now.after);
            const auto fill = [&](const Sources& sources, NanoTree& tree, const auto& shown) {
                parallel::forEachBlock(sources.size(), leavesPerBlock, [&](std::size_t first, std::size_t count) {
                    for (std::size_t leaf = first; leaf < first + count; ++leaf) {
                        const auto [before, after] = sources[leaf];
                        float* const to = tree.valuesOf(leaf);
                        for (int i = 0; i < brickCells; ++i)
                            to[i] =
                                shown((before ? (1 - now.share) * before[i] : 0) + (after ? now.share * after[i] : 0));
                    }
                });
            };
            fill(densities_, between_.density, [](float density) { return density; });
            if (!setup_.fire.empty())
                fill(temperatures_, between_.reaction, [&](float temperature) { return freshness(temperature); });
        }
        shown_ = now;
    }
    last_ = isMoment ? &moments_[now.before] : &between_;
    return *last_;
}

}  // namespace dustbench::volume
