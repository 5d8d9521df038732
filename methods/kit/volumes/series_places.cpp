#include "methods/kit/volumes/series_places.h"

#include <fmt/format.h>

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/matching_files.h"

namespace dustbench::volumes {

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

}  // namespace dustbench::volumes
