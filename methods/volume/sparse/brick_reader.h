// Reads a volume's file and keeps only the bricks with density, and the temperatures that are visible with them.
//
// Cells are placed on the lattice of a series, +Y up. Memory grows with the number of bricks with density. Units and
// frame: the file's, except for places, which are in the world. Source: Museth2013. Departs: the file is read cell by
// cell.
#pragma once

#include <filesystem>
#include <optional>
#include <unordered_map>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/volumes/grid_place.h"
#include "methods/kit/volumes/volume_setup.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

/// The first cell of a series' first file on the lattice: one brick above 0, so that samples that reach below it stay
/// in the same nodes of a tree.
inline constexpr int leadCell = brickEdge;

/// Bricks to keep, by row: the x positions of those at (y, z), ascending.
class BrickRows {
 public:
    void add(const glm::ivec3& brick) { rows_[keyOf({0, brick.y, brick.z})].push_back(brick.x); }
    /// Sorts; call this after all calls of add().
    void close();
    /// Null if there are none.
    [[nodiscard]] const std::vector<int>* find(int y, int z) const {
        const auto found = rows_.find(keyOf({0, y, z}));
        return found == rows_.end() ? nullptr : &found->second;
    }

 private:
    std::unordered_map<std::uint64_t, std::vector<int>> rows_;
};

class BrickReader final : public volumes::VolumeSink {
 public:
    /// `lead`: the place of the first file in the world; null for the first file itself.
    BrickReader(const std::filesystem::path& file, const volumes::VolumeSetup& setup, const volumes::GridPlace* lead);

    /// Reads the densities. Throws InputError as readVolume() does, and if too many bricks have density.
    void readDensities();
    /// Reads the temperatures of these bricks and keeps all of them.
    void readTemperatures(const BrickRows& rows);

    /// In the world.
    [[nodiscard]] const volumes::GridPlace& place() const { return place_; }
    [[nodiscard]] const glm::ivec3& firstCell() const { return first_; }
    [[nodiscard]] const Bricks& bricks() const { return bricks_; }

    void begin(const volumes::GridPlace& place) override;
    bool beginField(std::string_view field) override;
    void take(std::span<const float> numbers) override;

 private:
    void takeDensities(std::span<const float> row, glm::ivec3 first);
    void takeTemperatures(std::span<const float> row, glm::ivec3 first);
    [[nodiscard]] InputError refused(const std::string& reason) const;

    std::filesystem::path file_;
    const volumes::VolumeSetup& setup_;
    const volumes::GridPlace* lead_;
    const BrickRows* rows_ = nullptr;  ///< bricks whose temperatures are read; null: densities are read
    volumes::GridPlace stored_, place_;
    glm::ivec3 first_{leadCell};
    glm::ivec3 next_{0};  ///< the next cell, in the file's order
    Bricks bricks_;
    float lowest_ = 0, highest_ = 0;
};

}  // namespace dustbench::volume
