// Copies puffs from the CPU to GPU buffers of the form that dust on the GPU has.
//
// Owns: the buffers, which grow by doubling. Threads: the OpenGL thread's.
#pragma once

#include <cstdint>

#include "methods/contract/volume.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::octree {

class DUSTBENCH_API PuffUpload {
 public:
    explicit PuffUpload(gpu::Device& device) : device_(device) {}

    /// All columns except the velocities. Valid until the next call.
    [[nodiscard]] const GpuPuffs& upload(const Puffs& dust);
    [[nodiscard]] std::size_t bytes() const;

 private:
    gpu::Device& device_;
    gpu::Buffer position_, life_, look_, serial_, colour_, tally_;
    GpuPuffs puffs_;
};

}  // namespace dustbench::octree
