#include "methods/volume/sparse/brick_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "methods/kit/files/limits.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/volumes/volume_file.h"
#include "methods/kit/volumes/volume_series.h"

namespace dustbench::volume {
namespace {

constexpr std::uint32_t exponent = 0x7f800000u;

/// Whether all are 0 or −0.
bool areZero(std::span<const float> numbers) {
    std::uint32_t bits = 0;
    for (const float number : numbers) bits |= std::bit_cast<std::uint32_t>(number) << 1;
    return bits == 0;
}

bool areFinite(std::span<const float> numbers) {
    bool areSound = true;
    for (const float number : numbers) areSound &= (std::bit_cast<std::uint32_t>(number) & exponent) != exponent;
    return areSound;
}

std::size_t cellOf(const glm::ivec3& cell) {
    return static_cast<std::size_t>((cell.x & 7) << 6 | (cell.y & 7) << 3 | (cell.z & 7));
}

}  // namespace

void BrickRows::close() {
    for (auto& [key, row] : rows_) {
        std::ranges::sort(row);
        row.erase(std::ranges::unique(row).begin(), row.end());
    }
}

BrickReader::BrickReader(const std::filesystem::path& file, const volumes::VolumeSetup& setup,
                         const volumes::GridPlace* lead)
    : file_(file), setup_(setup), lead_(lead) {}

InputError BrickReader::refused(const std::string& reason) const {
    return InputError(fmt::format("{}: {}", file_.string(), files::printable(reason)));
}

void BrickReader::readDensities() {
    volumes::VolumeFields fields = setup_.fields;
    fields.isSparse = true;
    volumes::streamVolume(file_, fields, *this);
    if (lowest_ < 0) volumes::requireDensity(lowest_, highest_, file_, fields.clampsDensity);
}

void BrickReader::readTemperatures(const BrickRows& rows) {
    rows_ = &rows;
    volumes::VolumeFields fields = setup_.fields;
    fields.isSparse = true;
    volumes::streamVolume(file_, fields, *this);
}

void BrickReader::begin(const volumes::GridPlace& place) {
    stored_ = place;
    place_ = volumes::placedInWorld(place, setup_);
    for (int axis = 0; axis < 3; ++axis)
        if (place_.cells[axis] > files::limits::sparseVolumeEdge)
            throw refused(fmt::format("it has {} cells along an axis, allowed: {} (limit of sparse volumes)",
                                      place_.cells[axis], files::limits::sparseVolumeEdge));
    if (!lead_) return;
    // Leaves room for the whole box, and for a series that moves.
    constexpr double farthest = (farthestBrick - 4) * brickEdge - files::limits::sparseVolumeEdge;
    const glm::dvec3 apart = glm::abs(place_.origin - lead_->origin) / lead_->spacing;
    if (!(std::max({apart.x, apart.y, apart.z}) < farthest))
        throw refused(fmt::format("it is {:.3g} cells away from the first of its series, allowed: {:.3g}",
                                  std::max({apart.x, apart.y, apart.z}), farthest));
    first_ = volumes::firstCell(*lead_, place_) + leadCell;
}

bool BrickReader::beginField(std::string_view field) {
    next_ = glm::ivec3(0);
    return field == (rows_ ? "temperature" : "density");
}

void BrickReader::take(std::span<const float> numbers) {
    while (!numbers.empty()) {
        const std::size_t count = std::min(numbers.size(), static_cast<std::size_t>(stored_.cells.x - next_.x));
        // A row along x stays one if the grid is rotated.
        const glm::ivec3 turned = setup_.zUp ? glm::ivec3(next_.x, next_.z, stored_.cells.y - 1 - next_.y) : next_;
        if (rows_)
            takeTemperatures(numbers.first(count), first_ + turned);
        else
            takeDensities(numbers.first(count), first_ + turned);
        numbers = numbers.subspan(count);
        next_.x += static_cast<int>(count);
        if (next_.x < stored_.cells.x) continue;
        next_.x = 0;
        if (++next_.y < stored_.cells.y) continue;
        next_.y = 0;
        ++next_.z;
    }
}

void BrickReader::takeDensities(std::span<const float> row, glm::ivec3 first) {
    if (areZero(row)) return;
    if (!areFinite(row)) throw refused("it has a density that is not a number");
    Bricks::Values* values = nullptr;
    glm::ivec3 last(1 << 30);
    for (std::size_t i = 0; i < row.size(); ++i) {
        lowest_ = std::min(lowest_, row[i]);
        if (!(row[i] > 0)) continue;
        highest_ = std::max(highest_, row[i]);
        const glm::ivec3 cell = first + glm::ivec3(static_cast<int>(i), 0, 0);
        if (const glm::ivec3 brick = cell >> 3; brick != last) {
            values = &bricks_.at(brick);
            last = brick;
            if (bricks_.count() > static_cast<std::size_t>(files::limits::volumeBricks))
                throw refused(fmt::format("more than {} bricks of 8x8x8 cells have density (limit of sparse volumes)",
                                          files::limits::volumeBricks));
        }
        (*values)[cellOf(cell)] = row[i];
    }
}

void BrickReader::takeTemperatures(std::span<const float> row, glm::ivec3 first) {
    if (!areFinite(row)) throw refused("it has a temperature that is not a number");
    const std::vector<int>* const kept = rows_->find(first.y >> 3, first.z >> 3);
    if (!kept) return;
    const int end = first.x + static_cast<int>(row.size());
    for (auto brick = std::ranges::lower_bound(*kept, first.x >> 3); brick != kept->end() && *brick * 8 < end;
         ++brick) {
        Bricks::Values& values = bricks_.at({*brick, first.y >> 3, first.z >> 3});
        for (int x = std::max(*brick * 8, first.x); x < std::min(*brick * 8 + 8, end); ++x)
            values[cellOf({x, first.y, first.z})] = row[static_cast<std::size_t>(x - first.x)];
    }
}

}  // namespace dustbench::volume
