// A sparse volume that changes with time: the bricks of its moments, and interpolation between them.
//
// Between two moments every value changes linearly, as in VolumeSeries. Units: m, s; density is the files'. Frame:
// world (+Y up). Owns: the trees, booked on a ledger.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "methods/kit/volumes/volume_series.h"
#include "methods/volume/sparse/brick_reader.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

class SparseSeries {
 public:
    /// Records the files as inputs. Keeps temperatures if the setup has a fire. `ledger` must outlive this.
    /// Throws InputError with one line that names the file.
    SparseSeries(const volumes::VolumeSetup& setup, MemoryLedger& ledger);

    [[nodiscard]] bool isStill() const { return series_->isStill(); }
    [[nodiscard]] double seconds() const { return series_->seconds(); }
    /// The volume `seconds` after the first moment, valid until the next call.
    [[nodiscard]] const SparseMoment& at(double seconds);
    /// The last result of at().
    [[nodiscard]] const SparseMoment& shown() const { return *last_; }
    /// Changes whenever the result of at() does.
    [[nodiscard]] std::int64_t shows() const { return shows_; }

 private:
    /// Sources of a leaf's values in the moments before and after; null: 0.
    using Sources = std::vector<std::array<const float*, 2>>;

    void readDensities(std::vector<volumes::GridPlace>& places);
    void readTemperatures(const std::vector<volumes::GridPlace>& places);
    /// Bytes available for further trees.
    [[nodiscard]] std::size_t roomBytes() const;
    void prepare(std::size_t before, std::size_t after);
    /// Lays out a tree of the bricks of both moments and `others`.
    [[nodiscard]] Sources join(const NanoTree& before, const NanoTree& after, const std::vector<TreeBrick>& others,
                               NanoTree& joined) const;
    [[nodiscard]] float freshness(float temperature) const;

    volumes::VolumeSetup setup_;
    MemoryLedger& ledger_;
    std::vector<std::filesystem::path> names_;
    std::deque<SparseMoment> moments_;  ///< their `reaction` is the temperature, unless the series is still
    std::optional<volumes::SeriesPlaces> series_;
    std::optional<std::pair<std::size_t, std::size_t>> joined_;  ///< the moments that `between_` is laid out for
    SparseMoment between_;
    Sources densities_, temperatures_;
    std::optional<volumes::Between> shown_;
    const SparseMoment* last_ = nullptr;
    std::int64_t shows_ = 0;
};

}  // namespace dustbench::volume
