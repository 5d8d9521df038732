#include "methods/kit/volumes/vector_series.h"

#include <fmt/format.h>

#include <fnmatch.h>
#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/volumes/vector_file.h"

namespace dustbench::volumes {
namespace {

constexpr std::size_t maximumBytes = std::size_t{4} << 30;
constexpr double sameWithin = 1e-4;  ///< of a cell: grids that differ by less count as equal

std::size_t indexOf(const VectorGrid& grid, const glm::ivec3& cell) {
    return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(grid.cells.y) +
            static_cast<std::size_t>(cell.y)) *
               static_cast<std::size_t>(grid.cells.x) +
           static_cast<std::size_t>(cell.x);
}

std::size_t countOf(const glm::ivec3& cells) {
    return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(cells.z);
}

std::string describe(const VectorGrid& g) {
    return fmt::format("{}x{}x{} cells of {:.6g} m from ({:.6g}, {:.6g}, {:.6g})", g.cells.x, g.cells.y, g.cells.z,
                       g.spacing, g.origin.x, g.origin.y, g.origin.z);
}

/// Returns the offset of the second grid in cells of the first.
glm::dvec3 shift(const VectorGrid& a, const VectorGrid& b) {
    return (b.origin - a.origin) / a.spacing;
}

bool onOneLattice(const VectorGrid& a, const VectorGrid& b) {
    const glm::dvec3 cells = shift(a, b), off = glm::abs(cells - glm::round(cells));
    return std::abs(b.spacing / a.spacing - 1) < sameWithin && off.x < sameWithin && off.y < sameWithin &&
           off.z < sameWithin;
}

bool isSamePlace(const VectorGrid& a, const VectorGrid& b) {
    return onOneLattice(a, b) && a.cells == b.cells && glm::ivec3(glm::round(shift(a, b))) == glm::ivec3(0);
}

/// Pads a grid with zeros so that it covers `cells` cells from `first` on, in its own cells.
void pad(VectorGrid& grid, const glm::ivec3& first, const glm::ivec3& cells) {
    VectorGrid wide = grid;
    wide.cells = cells;
    wide.origin = grid.origin + grid.spacing * glm::dvec3(first);
    wide.values.assign(countOf(cells), glm::vec3(0));
    for (int z = 0; z < grid.cells.z; ++z)
        for (int y = 0; y < grid.cells.y; ++y) {
            const auto* const row = &grid.values[indexOf(grid, {0, y, z})];
            std::copy_n(row, grid.cells.x,
                        wide.values.begin() + static_cast<std::ptrdiff_t>(indexOf(wide, glm::ivec3(0, y, z) - first)));
        }
    grid = std::move(wide);
}

/// Sparse grids end where the field does; pads them to their common bounding box.
void bringTogether(std::vector<VectorGrid>& grids) {
    const VectorGrid& lead = grids.front();
    glm::ivec3 low(0), high = lead.cells;
    std::vector<glm::ivec3> firsts;
    for (const VectorGrid& grid : grids) {
        const glm::ivec3 first(glm::round(shift(lead, grid)));
        firsts.push_back(first);
        low = glm::min(low, first);
        high = glm::max(high, first + grid.cells);
    }
    for (std::size_t i = 0; i < grids.size(); ++i) pad(grids[i], low - firsts[i], high - low);
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
                      throw InputError(fmt::format("{}: the series takes more than {} GiB up to here", file.string(),
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
        if (!grid.timeSeconds && grids_.size() > 1)
            throw InputError(names[i].string() + ": has no time, which a file of a series needs");
        if (i > 0 && !(*grid.timeSeconds > *grids_[i - 1].timeSeconds))
            throw InputError(fmt::format("{}: its time is {} s, expected one after {} s, that of {}", names[i].string(),
                                         *grid.timeSeconds, *grids_[i - 1].timeSeconds,
                                         names[i - 1].filename().string()));
        if (!(sparse ? onOneLattice(grids_.front(), grid) : isSamePlace(grids_.front(), grid)))
            throw InputError(fmt::format("{}: lies on another grid than {}: got {}, expected {}", names[i].string(),
                                         names.front().filename().string(), describe(grid), describe(grids_.front())));
    }
    if (!grids_.front().timeSeconds) grids_.front().timeSeconds = 0;
    if (sparse) bringTogether(grids_);
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
        const std::size_t i = indexOf(grid, glm::mix(low, high, glm::bvec3(upper)));
        sum += along.x * along.y * along.z * glm::mix(before_->values[i], after_->values[i], share_);
    }
    return sum;
}

std::size_t VectorSeries::bytes() const {
    std::size_t bytes = 0;
    for (const VectorGrid& grid : grids_) bytes += grid.values.size() * sizeof(glm::vec3);
    return bytes;
}

std::vector<std::filesystem::path> matchingFiles(const std::filesystem::path& pattern) {
    namespace fs = std::filesystem;
    const std::string name = pattern.filename().string();
    std::vector<fs::path> files;
    std::error_code error;
    if (name.find('*') == std::string::npos) {
        files.push_back(pattern);
    } else {
        for (const auto& entry : fs::directory_iterator(pattern.has_parent_path() ? pattern.parent_path() : ".", error))
            if (fnmatch(name.c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0) files.push_back(entry.path());
        std::ranges::sort(files);
    }
    if (files.empty() || !fs::is_regular_file(files.front(), error))
        throw InputError(pattern.string() +
                         ": no such file, expected .vti or .vdb files as `dustbench export` writes them");
    for (const fs::path& file : files) files::noteInput(file);
    return files;
}

}  // namespace dustbench::volumes
