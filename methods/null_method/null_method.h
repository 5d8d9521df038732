// A method that draws nothing: it measures the baseline cost of a frame, plus a load of known size to validate timing.
#pragma once

#include <cstdint>

#include "methods/contract/method.h"

namespace dustbench::null_method {

/// Draws 1000 random numbers per unit on one thread. Returns their sum, so that the compiler cannot drop the work.
[[nodiscard]] std::uint32_t fixedWork(std::uint64_t units);

class NullMethod final : public Method {
 public:
    explicit NullMethod(std::uint64_t work) : work_(work) {}

    void prepare(const scene::Scene&, const RunSetup&, gpu::Device&) override {}
    void update(const Frame& frame) override;
    void draw(const Frame&, gpu::Layer&) override {}

 private:
    std::uint64_t work_;
    volatile std::uint32_t workDone_ = 0;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::null_method
