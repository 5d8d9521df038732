// Draws dust as octree voxels that are built, sorted and listed on the GPU (`layout=gpu`): the voxels and pictures of
// OctreeDust. Takes dust from GPU buffers, and uploads dust from the CPU. A frame reads nothing back.
//
// Source: Carr2006, 3.2 and 3.5.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "methods/contract/method.h"
#include "methods/contract/volume.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/cubes.h"
#include "methods/kit/draw/gpu_depth_order.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/octree/gpu/gpu_march.h"
#include "methods/kit/octree/gpu/gpu_octree.h"
#include "methods/kit/octree/octree_dust.h"

namespace dustbench::octree {

/// Copies puffs from the CPU to GPU buffers of the form that dust on the GPU has. Owns the buffers, which grow by
/// doubling. Threads: the OpenGL thread's.
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

/// True for `layout=gpu`: for MethodInfo::takesGpuDust.
[[nodiscard]] DUSTBENCH_API bool isBuiltOnGpu(const ParameterValues& values);

class DUSTBENCH_API GpuOctreeDust final : public Method {
 public:
    /// Throws InputError for settings that only the CPU has: quicksort, kept voxels and cross-fading.
    explicit GpuOctreeDust(const DustSettings& settings);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    /// Throws SimulationError if a position was not a number in any frame, and InputError if a tree to march through
    /// was too large.
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] const gpu::Buffer* primitiveCount() const override;

    [[nodiscard]] const GpuOctree& tree() const { return *tree_; }

 private:
    DustSettings settings_;
    gpu::Device* device_ = nullptr;
    std::optional<GpuOctree> tree_;
    std::optional<PuffUpload> upload_;
    std::optional<draw::GpuDepthOrder> order_;
    std::optional<draw::Billboards> billboards_;
    std::optional<draw::Cubes> cubes_;
    std::optional<GpuMarch> march_;
};

}  // namespace dustbench::octree
