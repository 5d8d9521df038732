// The mapping of distances that transparency along rays is stored in, from the nearest puff of a frame to the farthest.
// Shaders read it as `layout(std140, binding = 0) uniform …  { vec2 NAME; };`: an offset and a factor.
//
// For dust in GPU buffers, the range is found there. A method's piece of shader defines
//
//     vec2 extentOf(float axisMetres, float metres, float deviationMetres, float nearMetres)
//         the nearest and the farthest distance of a puff whose centre is at `axisMetres` along the camera's axis and
//         `metres` from the eye; a negative farthest distance leaves the puff out
//     vec2 mappingOf(float nearestMetres, float farthestMetres, float nearMetres)
//         the two numbers, from the nearest and the farthest of all distances; farthest < nearest if no puff counts
//
// where `nearMetres` is the camera's. Distances below 0 count as 0.
//
// Owns: 24 bytes, on the GPU. Threads: the OpenGL thread.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>

#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/shader_file.h"

namespace dustbench::draw {

class DUSTBENCH_API DepthMapping {
 public:
    DepthMapping(gpu::Device& device, gpu::ShaderFile piece, std::map<std::string, std::string> definitions);

    /// For the next draws.
    void use(const glm::vec2& mapping);
    /// The same, from the range of these puffs. Reads nothing back.
    void useRangeOf(const GpuPuffs& dust, const scene::View& view);

    /// The two numbers.
    [[nodiscard]] const gpu::Buffer& numbers() const { return mapping_; }

 private:
    /// Compiled on first use.
    struct Passes {
        gpu::Program range, mapping;
        gpu::Buffer ends;
    };

    gpu::Device& device_;
    gpu::ShaderFile piece_;
    std::map<std::string, std::string> definitions_;
    gpu::Buffer mapping_;
    std::optional<Passes> passes_;
};

}  // namespace dustbench::draw
