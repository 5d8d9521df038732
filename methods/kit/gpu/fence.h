// A marker in the GPU's command queue that the CPU can wait for.
#pragma once

namespace dustbench::gpu {

class DUSTBENCH_API Fence {
 public:
    Fence() = default;
    /// A marker after all work queued so far.
    [[nodiscard]] static Fence afterQueuedWork();
    ~Fence();
    Fence(Fence&& other) noexcept;
    Fence& operator=(Fence&& other) noexcept;

    /// Blocks until the work before the marker is done; returns at once if there is no marker.
    void wait();

 private:
    void* sync_ = nullptr;
};

}  // namespace dustbench::gpu
