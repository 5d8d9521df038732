#include "methods/kit/volumes/vector_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

constexpr std::size_t maximumBytes = std::size_t{4} << 30;

/// Pads a grid with zeros so that it covers the cells of `place`.
void pad(VectorGrid& grid, const GridPlace& place) {
    VectorGrid wide = grid;
    wide.cells = place.cells;
    wide.origin = place.origin;
    wide.values.assign(wide.cellCount(), glm::vec3(0));
    forEachRow(grid, wide, [&](std::size_t from, std::size_t to, std::size_t count) {
        std::copy_n(&grid.values[from], count, &wide.values[to]);
    });
    grid = std::move(wide);
}

/// Sparse grids end where the field does; pads them to their common bounding box.
void bringTogether(std::vector<VectorGrid>& grids, std::span<const std::filesystem::path> names) {
    GridPlace place = grids.front();
    for (std::size_t i = 0; i < grids.size(); ++i) {
        place = enclosing(place, grids[i]);
        if (cellsOf(place) * static_cast<double>(grids.size() * sizeof(glm::vec3)) > static_cast<double>(maximumBytes))
            throw InputError(fmt::format("{}: the box of the series up to this file takes over {} GiB",
                                         names[i].string(), maximumBytes >> 30));
    }
    for (VectorGrid& grid : grids) pad(grid, place);
}

}  // namespace

VectorSeries::VectorSeries(std::span<const std::filesystem::path> files, const std::string& field)
    : VectorSeries(
          [&] {
              std::vector<VectorGrid> grids;
              std::size_t bytes = 0;
              for (const std::filesystem::path& file : files) {
                  grids.push_back(readVectors(file, field));
                  bytes += grids.back().values.size() * sizeof(glm::vec3);
                  if (bytes > maximumBytes)
                      throw InputError(fmt::format("{}: the series up to this file takes over {} GiB", file.string(),
                                                   maximumBytes >> 30));
              }
              return grids;
          }(),
          files) {}

VectorSeries::VectorSeries(std::vector<VectorGrid> grids, std::span<const std::filesystem::path> names)
    : grids_(std::move(grids)) {
    if (grids_.empty()) throw InputError("a series of vectors: got no file, expected one or more");
    const bool sparse = std::ranges::all_of(grids_, &VectorGrid::sparse);
    for (std::size_t i = 0; i < grids_.size(); ++i) {
        const VectorGrid& grid = grids_[i];
        if (grids_.size() > 1)
            requireGoesOn(grid, names[i], i > 0 ? &grids_[i - 1] : nullptr, names[i > 0 ? i - 1 : 0], grids_.front(),
                          names.front(), sparse);
    }
    if (!grids_.front().timeSeconds) grids_.front().timeSeconds = 0;
    if (sparse) bringTogether(grids_, names);
}

VectorSeries::Moment VectorSeries::momentAt(double timeSeconds) const {
    const auto later =
        std::ranges::find_if(grids_, [timeSeconds](const VectorGrid& grid) { return *grid.timeSeconds > timeSeconds; });
    Moment moment;
    moment.before_ = later == grids_.begin() ? &*later : &*std::prev(later);
    moment.after_ = later == grids_.end() ? moment.before_ : &*later;
    const double start = *moment.before_->timeSeconds, length = *moment.after_->timeSeconds - start;
    moment.share_ = length > 0 ? static_cast<float>((timeSeconds - start) / length) : 0;
    return moment;
}

std::optional<glm::vec3> VectorSeries::Moment::at(const glm::dvec3& point) const {
    const VectorGrid& grid = *before_;
    const glm::dvec3 cells(grid.cells), place = (point - grid.origin) / grid.spacing;
    if (!glm::all(glm::greaterThanEqual(place, glm::dvec3(0))) || !glm::all(glm::lessThanEqual(place, cells)))
        return std::nullopt;
    const glm::dvec3 fromFirst = glm::clamp(place - 0.5, glm::dvec3(0), cells - 1.0);
    const glm::ivec3 low = glm::min(glm::ivec3(fromFirst), glm::max(grid.cells - 2, glm::ivec3(0)));
    const glm::ivec3 high = glm::min(low + 1, grid.cells - 1);
    const glm::vec3 share(fromFirst - glm::dvec3(low));
    glm::vec3 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 upper(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 along = glm::mix(1.0f - share, share, glm::vec3(upper));
        const std::size_t i = grid.indexOf(glm::mix(low, high, glm::bvec3(upper)));
        sum += along.x * along.y * along.z * glm::mix(before_->values[i], after_->values[i], share_);
    }
    return sum;
}

std::size_t VectorSeries::bytes() const {
    std::size_t bytes = 0;
    for (const VectorGrid& grid : grids_) bytes += grid.values.size() * sizeof(glm::vec3);
    return bytes;
}

}  // namespace dustbench::volumes
