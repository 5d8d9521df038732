// The puffs of one moment as a view sees them, and for each tile of its picture the list of those that reach into it.
//
// A list holds the puffs around the eye first, then the others, ordered by distance. Rays that pass a puff at a
// distance of R or more are unaffected: there τ·exp(−R²/2s²) is a share 1/puffs of the tolerated depth.
//
// Units: metres, pixels. Frame: camera axes (x right, y up, z ahead), pixels from the lower left corner.
// Owns: all of it. Threads: uses the current oneTBB arena; the same lists at any number of threads.
#pragma once

#include <cstdint>
#include <span>

#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::exact_tiles {

inline constexpr int tilePixels = 8;  ///< edge of a tile
/// Along a ray, a puff ends this many s from its centre; ½·erfc(4.75/√2) = 1e-6 of its depth lies beyond.
inline constexpr double sigmasAlongRay = 4.75;

/// A puff as the shaders read it. Of a puff ahead of the eye: the pixel of its centre as an integer and a fraction, so
/// that the offset of a pixel from it does not cancel. Of one around the eye: its centre.
struct PackedPuff {
    float pixelX, pixelY, fractionX, fractionY;  ///< around the eye: the centre x, y, z; unused
    float slopeX, slopeY, axisMetres, front;     ///< centre/axis distance; nearest distance of its extinction
    float logDepth;                              ///< log2 τ
    float falloff;       ///< log2(e)/2s², times (axis distance · slope per pixel)² if ahead of the eye
    float inverseWidth;  ///< 1/(√2·s)
    float back;          ///< farthest distance of its extinction
    float red, green, blue, unused;
};

/// Where a tile's list begins, and where in it the puffs ahead of the eye do. It ends where the next one begins.
struct TileList {
    std::uint32_t begin, ahead;
};

/// What orders the puffs ahead of the eye.
enum class Along { back, front };

class PuffTiles {
 public:
    explicit PuffTiles(MemoryLedger& ledger);

    /// Throws std::invalid_argument for a camera without a direction.
    void build(const Puffs& dust, const scene::View& view, double toleratedDepth, Along order);

    [[nodiscard]] std::span<const PackedPuff> puffs() const { return packed_; }
    /// Row by row from below, and one more, where the last list ends.
    [[nodiscard]] std::span<const TileList> lists() const { return lists_; }
    [[nodiscard]] std::span<const std::uint32_t> entries() const { return entries_; }
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }

 private:
    /// Tiles that a puff may touch, and the cone of rays that it affects.
    struct Footprint {
        std::int16_t firstColumn, endColumn, firstRow, endRow;
        float x, y, z;      ///< unit vector to the centre
        float leastCosine;  ///< of the angle to a tile's centre; −2: any tile
    };
    struct Unordered {
        PackedPuff puff;
        Footprint footprint;
        float key;
    };

    void project(const Puffs& dust, const scene::View& view, double toleratedDepth, Along order);
    void list(const scene::View& view);

    LedgerVector<Unordered> seen_;
    LedgerVector<std::uint32_t> order_;
    LedgerVector<Footprint> footprints_;
    LedgerVector<PackedPuff> packed_;
    LedgerVector<TileList> lists_;
    LedgerVector<std::uint32_t> entries_;
    std::size_t aroundEye_ = 0;  ///< so many of `packed_` come first
    int columns_ = 0, rows_ = 0;
};

}  // namespace dustbench::exact_tiles
