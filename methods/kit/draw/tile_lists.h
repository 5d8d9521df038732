// For each tile of a picture, the shapes that may cover it, in their order: made and used on the GPU.
//
// Tiles have 8 × 8 pixels at level 0, and twice the edge at each further level. A shape is listed in the tiles of the
// finest level at which it has at most two columns and two rows of them. So lists never have more than four entries per
// shape, however large the shapes are; a tile of level 0 is covered by the shapes in its own list and in those of the
// tiles around it. tile_shapes.glsl merges them in the shapes' order.
//
//     count the tiles of each shape → sums → pairs of tile and shape → stable sort by tile → ranges of tiles
//
// Shaders of a user get `uniform ivec3 picture` from tile_pyramid.glsl; `describe` sets it.
//
// Units: pixels, rows from the bottom. Owns: lists (about 72 bytes per shape), on the GPU. Threads: the OpenGL thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/shader_file.h"
#include "methods/kit/gpu/sort/radix_sort.h"
#include "methods/kit/gpu/sort/scan.h"

namespace dustbench::draw {

class DUSTBENCH_API TileLists {
 public:
    static constexpr int tilePixels = 8;

    /// `pieces` (.glsl) define `ivec4 pixelsOf(uint shape)`, see tile_pairs.comp. They may use storage bindings 0, 6
    /// and 7.
    TileLists(gpu::Device& device, const char* name, const std::vector<gpu::ShaderFile>& pieces,
              const std::map<std::string, std::string>& definitions = {});

    /// Shapes on the GPU: their number is `number`, or word 0 of `numberOnGpu`, which then is at most `number`.
    struct Shapes {
        std::uint32_t number = 0;
        const gpu::Buffer* numberOnGpu = nullptr;
    };
    /// Makes the lists. `prepare` sets the uniforms of the pieces and binds their buffers; it is called for each of two
    /// programs. Throws InputError if the device has no buffers for so many shapes, or no picture of this size.
    void build(const Shapes& shapes, int width, int height, const std::function<void(gpu::Program&)>& prepare);

    /// Sets the uniform `picture` of a program with tile_pyramid.glsl, for the size of the last `build`.
    void describe(gpu::Program& program) const;
    /// Binds the lists for tile_shapes.glsl: bindings 1 and 2.
    void bind() const;
    [[nodiscard]] int columns() const { return tilesAlong(width_); }
    [[nodiscard]] int rows() const { return tilesAlong(height_); }
    [[nodiscard]] std::size_t bytes() const;

    /// For tests: begin and end of each tile's list, level by level and row by row; the shapes in the lists.
    [[nodiscard]] const gpu::Buffer& ranges() const { return ranges_; }
    [[nodiscard]] const gpu::Buffer& shapesOfTiles() const { return pairs_->shapes; }
    [[nodiscard]] int levels() const { return levels_; }

 private:
    /// Everything whose size depends on the number of shapes.
    struct Pairs {
        Pairs(gpu::Device& device, std::uint32_t shapes);

        std::uint32_t capacity;
        gpu::Buffer ends, tiles, shapes;
        gpu::InclusiveScan scan;
        gpu::RadixSort sort;
    };

    static int tilesAlong(int pixels) { return (pixels + tilePixels - 1) / tilePixels; }
    void resize(int width, int height);
    void reserve(std::uint32_t shapes);

    gpu::Device& device_;
    std::string name_;
    gpu::Program count_, emit_, findRanges_;
    gpu::Buffer number_;     ///< of shapes, if the CPU knows it
    gpu::Buffer pairCount_;  ///< the number of pairs, then the work groups of a dispatch over them
    gpu::Buffer ranges_;
    std::unique_ptr<Pairs> pairs_;     ///< not std::optional, of which GCC 14 warns falsely
    std::uint32_t writtenNumber_ = 0;  ///< in `number_`
    int width_ = 0, height_ = 0, levels_ = 0;
    std::size_t tiles_ = 0;  ///< of all levels
};

}  // namespace dustbench::draw
