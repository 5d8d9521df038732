// The puffs of one moment as seen by a view, with a list for each tile of the image of the puffs that reach into it.
//
// A list contains the puffs around the eye first, then the others, ordered by distance. Puffs are ignored for rays
// that pass at a distance of R or more, where τ·exp(−R²/2s²) is 1/(number of puffs) of the tolerated depth.
//
// Units: metres, pixels. Frame: camera axes (x right, y up, z ahead), pixels from the lower left corner.
// Owns: all of it. Threads: uses the current oneTBB arena; results do not depend on the number of threads.
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

/// A puff as the shaders read it. For a puff ahead of the eye, the pixel of its centre is stored as an integer and a
/// fraction to avoid cancellation in a pixel's offset from it. For a puff around the eye, its centre is stored.
struct PackedPuff {
    float pixelX, pixelY, fractionX, fractionY;  ///< around the eye: the centre x, y, z; unused
    float slopeX, slopeY, axisMetres, front;     ///< centre/axis distance; nearest distance of its extinction
    float logDepth;                              ///< log2 τ
    float falloff;       ///< log2(e)/2s², times (axis distance · slope per pixel)² if ahead of the eye
    float inverseWidth;  ///< 1/(√2·s)
    float back;          ///< farthest distance of its extinction
    float red, green, blue, unused;
};

/// The beginning of a tile's list, and of the puffs ahead of the eye in it. A list ends where the next one begins.
struct TileList {
    std::uint32_t begin, ahead;
};

/// Sort key of the puffs ahead of the eye.
enum class Along { back, front };

class PuffTiles {
 public:
    explicit PuffTiles(MemoryLedger& ledger);

    /// Throws std::invalid_argument for a camera without a direction.
    void build(const Puffs& dust, const scene::View& view, double toleratedDepth, Along order);

    [[nodiscard]] std::span<const PackedPuff> puffs() const { return packed_; }
    /// Row by row from the bottom, plus one entry for the end of the last list.
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
    std::size_t aroundEye_ = 0;  ///< number of puffs around the eye; they come first in `packed_`
    int columns_ = 0, rows_ = 0;
};

}  // namespace dustbench::exact_tiles
