// The order of GPU dust from the farthest puff to the nearest, on the GPU: that of DepthSort for the same puffs.
//
// Owns: keys and indices (20 bytes per puff). Threads: the OpenGL thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "methods/contract/volume.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/sort/radix_sort.h"

namespace dustbench::draw {

class DUSTBENCH_API GpuDepthOrder {
 public:
    explicit GpuDepthOrder(gpu::Device& device);

    /// Indices of the puffs by decreasing distance from the eye; ties by ascending index. Valid until the next call.
    const gpu::Buffer& farToNear(const GpuPuffs& dust, const glm::vec3& eye);
    [[nodiscard]] std::size_t bytes() const;

 private:
    /// Everything whose size depends on the number of puffs.
    struct Sorting {
        Sorting(gpu::Device& device, std::uint32_t puffs);

        std::uint32_t capacity;
        gpu::Buffer depths, keys, indices;
        gpu::DepthKeys depthKeys;
        gpu::RadixSort sort;
    };

    gpu::Device& device_;
    gpu::Program distances_;
    std::optional<Sorting> sorting_;
};

}  // namespace dustbench::draw
