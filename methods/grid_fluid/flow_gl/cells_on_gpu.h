// The state of a fluid on the GPU, and the results of a step.
//
// Units: metres per second, kelvin above the air. Owns the buffers. Threads: the OpenGL thread's.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/kit/gpu/buffer.h"

namespace dustbench::grid_fluid::flow_gl {

/// The contents of flow::CellField, in two buffers of the same order.
struct CellsOnGpu {
    CellsOnGpu(gpu::Device& device, std::string_view label, const flow::CellLayout& layout)
        : moving(device, label, layout.padded() * bytesMoving), carried(device, label, layout.padded() * bytesCarried) {
        moving.clear();
        carried.clear();
    }

    /// Binds both buffers to consecutive binding points.
    void bind(std::uint32_t first) const {
        moving.bindStorage(first);
        carried.bindStorage(first + 1);
    }
    [[nodiscard]] std::size_t bytes() const { return moving.bytes() + carried.bytes(); }

    static constexpr std::size_t bytesMoving = 4 * sizeof(float), bytesCarried = 2 * sizeof(float);
    gpu::Buffer moving;   ///< velocity and density
    gpu::Buffer carried;  ///< temperature and reaction
};

/// Results of a step that the host needs, in one small buffer that is read once, after all work is queued.
///
/// Values are non-negative floats stored as bits: the bits order like the values, so atomicMax finds the maximum
/// independently of the execution order.
class StepReportOnGpu {
 public:
    static constexpr std::uint32_t binding = 7;
    static constexpr int lanes = 6;
    static constexpr int unremovable = lanes, firstResidual = lanes + 1;

    StepReportOnGpu(gpu::Device& device, int residuals)
        : values_(static_cast<std::size_t>(firstResidual + residuals)),
          buffer_(device, "fluid report", values_.size() * sizeof(std::uint32_t)) {}

    /// Resets the maximum magnitudes of the cells' quantities; those of the velocity start with the wind's.
    void restartMaximum(const glm::vec3& wind) {
        std::uint32_t initial[lanes]{};
        for (int axis = 0; axis < 3; ++axis) initial[axis] = std::bit_cast<std::uint32_t>(std::abs(wind[axis]));
        buffer_.write(std::span<const std::uint32_t>(initial));
    }
    /// Resets all values, including the maximum magnitudes.
    void restart() { buffer_.clear(); }
    void bind() const { buffer_.bindStorage(binding); }
    /// Waits for the GPU.
    void read() { buffer_.read(std::span<std::uint32_t>(values_)); }

    [[nodiscard]] float at(int slot) const { return std::bit_cast<float>(values_[static_cast<std::size_t>(slot)]); }
    [[nodiscard]] bool anyNumberLost() const {
        for (int lane = 0; lane < lanes; ++lane)
            if (!(at(lane) <= std::numeric_limits<float>::max())) return true;
        return false;
    }

 private:
    std::vector<std::uint32_t> values_;
    gpu::Buffer buffer_;
};

}  // namespace dustbench::grid_fluid::flow_gl
