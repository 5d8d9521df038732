// A volume that changes with time, kept sparse: the bricks of its moments, and what is shown between them.
//
// Between two moments every value changes evenly, as in VolumeSeries. Units: m, s; density is the files'. Frame: world
// (+Y up). Owns: the trees, booked on a ledger.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "methods/kit/volumes/series_places.h"
#include "methods/volume/sparse/brick_reader.h"
#include "methods/volume/sparse/sparse_moment.h"

namespace dustbench::volume {

class SparseSeries {
 public:
    /// Notes the files as inputs. Temperature is kept if the setup has a fire. `ledger` must outlive this.
    /// Throws InputError, one line with the file.
    SparseSeries(const volumes::VolumeSetup& setup, MemoryLedger& ledger);

    [[nodiscard]] bool isStill() const { return series_->isStill(); }
    [[nodiscard]] double seconds() const { return series_->seconds(); }
    /// The volume so many seconds after the first moment, valid until the next call.
    [[nodiscard]] const SparseMoment& at(double seconds);
    /// What at() returned last.
    [[nodiscard]] const SparseMoment& shown() const { return *last_; }
    /// Changes whenever what at() returns does.
    [[nodiscard]] std::int64_t shows() const { return shows_; }

 private:
    /// Where the values of a leaf come from: of the moment before and of the one after; null: 0.
    using Sources = std::vector<std::array<const float*, 2>>;

    void readDensities(std::vector<volumes::GridPlace>& places);
    void readTemperatures(const std::vector<volumes::GridPlace>& places);
    /// Bytes that further trees may take.
    [[nodiscard]] std::size_t roomBytes() const;
    void prepare(std::size_t before, std::size_t after);
    /// Lays out a tree of the bricks of both moments and of others.
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
