#include "methods/kit/volumes/volume_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/volumes/file_series.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

std::size_t bytesOf(const VolumeGrid& grid) {
    return (grid.density.size() + grid.temperature.size()) * sizeof(float) + grid.velocity.size() * sizeof(glm::vec3);
}

/// Converts values of a grid from +Z up to +Y up: (x, y, z) becomes (x, z, −y).
template <typename Value>
void turn(std::vector<Value>& values, const GridPlace& from, const GridPlace& to) {
    if (values.empty()) return;
    std::vector<Value> turned(values.size());
    for (int z = 0; z < from.cells.z; ++z)
        for (int y = 0; y < from.cells.y; ++y)
            std::copy_n(&values[from.indexOf({0, y, z})], from.cells.x,
                        &turned[to.indexOf({0, z, from.cells.y - 1 - y})]);
    values = std::move(turned);
}

template <typename Value>
void addShare(const std::vector<Value>& values, const GridPlace& from, float share, const GridPlace& to,
              std::vector<Value>& sum) {
    forEachRow(from, to, [&](std::size_t source, std::size_t target, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) sum[target + i] += share * values[source + i];
    });
}

/// (1 − share)·a + share·b within `to`; empty if one of them has no such field.
template <typename Value>
void blend(const VolumeGrid& a, const VolumeGrid& b, std::vector<Value> VolumeGrid::*field, float share,
           VolumeGrid& to) {
    (to.*field).clear();
    if ((a.*field).empty() || (b.*field).empty()) return;
    (to.*field).assign(to.cellCount(), Value(0));
    addShare(a.*field, a, 1 - share, to, to.*field);
    addShare(b.*field, b, share, to, to.*field);
}

InputError tooMuch(const std::filesystem::path& file, double bytes) {
    return InputError(
        fmt::format("{}: the series up to this file takes {:.3g} GB, allowed: {:.3g} GB (limit of volumes)",
                    file.string(), bytes / 1e9, static_cast<double>(files::limits::dustBytes) / 1e9));
}

std::vector<GridPlace> placesOf(const std::vector<VolumeGrid>& moments) {
    return {moments.begin(), moments.end()};  // only the positions
}

}  // namespace

GridPlace placedInWorld(const GridPlace& place, const VolumeSetup& setup) {
    GridPlace placed = place;
    if (setup.zUp) {
        placed.cells = {place.cells.x, place.cells.z, place.cells.y};
        placed.origin = {place.origin.x, place.origin.z, -(place.origin.y + place.cells.y * place.spacing)};
    }
    placed.origin = placed.origin * setup.metresPerUnit + setup.position;
    placed.spacing *= setup.metresPerUnit;
    return placed;
}

SeriesPlaces::SeriesPlaces(std::vector<GridPlace> places, const std::vector<std::filesystem::path>& names,
                           std::optional<double> secondsPerFile, std::int64_t maximumCells)
    : places_(std::move(places)) {
    if (places_.empty()) throw InputError("a series of volumes: got no file, expected one or more");
    const bool haveNone =
        std::ranges::none_of(places_, [](const GridPlace& place) { return place.timeSeconds.has_value(); });
    if (const std::string uneven = secondsPerFile && haveNone ? files::unevenStep(names) : ""; !uneven.empty())
        throw InputError(
            fmt::format("{}: {}; expected even steps for seconds_per_file, or a .pvd or .series with the times",
                        names.front().parent_path().string(), uneven));
    if (secondsPerFile && haveNone)
        for (std::size_t i = 0; i < places_.size(); ++i)
            places_[i].timeSeconds = static_cast<double>(i) * *secondsPerFile;
    if (isStill()) return;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        if (!places_[i].timeSeconds)
            throw InputError(names[i].string() +
                             ": has no time, expected TimeValue (.vti), time_s (.vdb), a .pvd or .series with "
                             "times, or seconds_per_file in a .toml");
        const std::size_t before = i > 0 ? i - 1 : 0;
        requireGoesOn(places_[i], names[i], i > 0 ? &places_[before] : nullptr, names[before], places_[0], names[0],
                      /*anyCells=*/true);
        if (cellsOf(enclosing(places_[before], places_[i])) > static_cast<double>(maximumCells))
            throw InputError(fmt::format("{}: together with {} it has more than {} cells (limit of volumes)",
                                         names[i].string(), names[before].filename().string(), maximumCells));
    }
}

double SeriesPlaces::seconds() const {
    return isStill() ? 0 : *places_.back().timeSeconds - *places_.front().timeSeconds;
}

Between SeriesPlaces::at(double seconds) const {
    if (isStill()) return {};
    const double time = *places_.front().timeSeconds + seconds;
    const auto after = std::ranges::upper_bound(places_, time + sameMomentSeconds, {},
                                                [](const GridPlace& place) { return *place.timeSeconds; });
    if (after == places_.begin()) return {};
    const auto index = static_cast<std::size_t>(after - places_.begin());
    const double passed = time - *places_[index - 1].timeSeconds;
    if (after == places_.end() || passed <= sameMomentSeconds) return {index - 1, index - 1, 0};
    return {index - 1, index, static_cast<float>(passed / (*after->timeSeconds - *places_[index - 1].timeSeconds))};
}

void placeInWorld(VolumeGrid& grid, const VolumeSetup& setup) {
    const GridPlace from = static_cast<const GridPlace&>(grid);  // only the position
    static_cast<GridPlace&>(grid) = placedInWorld(from, setup);
    if (setup.zUp) {
        turn(grid.density, from, grid);
        turn(grid.temperature, from, grid);
        turn(grid.velocity, from, grid);
        for (glm::vec3& v : grid.velocity) v = {v.x, v.z, -v.y};
    }
    for (glm::vec3& v : grid.velocity) v *= static_cast<float>(setup.metresPerUnit);
}

VolumeSeries VolumeSeries::read(const VolumeSetup& setup) {
    std::vector<VolumeGrid> moments;
    std::vector<std::filesystem::path> names;
    double bytes = 0;
    for (const SeriesEntry& entry : seriesEntries(setup.files, "volumes")) {
        files::noteInput(entry.file);
        VolumeGrid& grid = moments.emplace_back(readVolume(entry.file, setup.fields));
        if (entry.timeSeconds) grid.timeSeconds = entry.timeSeconds;
        placeInWorld(grid, setup);
        bytes += static_cast<double>(bytesOf(grid));
        if (bytes > static_cast<double>(files::limits::dustBytes)) throw tooMuch(entry.file, bytes);
        names.push_back(entry.file);
    }
    return {std::move(moments), std::move(names), setup.secondsPerFile};
}

VolumeSeries::VolumeSeries(std::vector<VolumeGrid> moments, std::vector<std::filesystem::path> names,
                           std::optional<double> secondsPerFile)
    : moments_(std::move(moments)),
      names_(std::move(names)),
      series_(placesOf(moments_), names_, secondsPerFile, files::limits::volumeCells) {
    for (std::size_t i = 0; i < moments_.size(); ++i) moments_[i].timeSeconds = series_.places()[i].timeSeconds;
}

std::size_t VolumeSeries::bytes() const {
    return std::accumulate(moments_.begin(), moments_.end(), std::size_t{0},
                           [](std::size_t sum, const VolumeGrid& grid) { return sum + bytesOf(grid); });
}

const VolumeGrid& VolumeSeries::at(double seconds, bool wantsVelocity, VolumeGrid& between) const {
    const auto [before, next, share] = series_.at(seconds);
    const VolumeGrid &from = moments_[before], &after = moments_[next];
    if (share == 0) return from;
    static_cast<GridPlace&>(between) = enclosing(from, after);
    between.timeSeconds = *moments_.front().timeSeconds + seconds;
    blend(from, after, &VolumeGrid::density, share, between);
    blend(from, after, &VolumeGrid::temperature, share, between);
    between.velocity.clear();
    if (wantsVelocity) blend(from, after, &VolumeGrid::velocity, share, between);
    return between;
}

}  // namespace dustbench::volumes
