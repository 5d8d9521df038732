// The method that draws nothing: what a frame costs without any, and a load of known size to check the measurement by.
#pragma once

#include <cstdint>

#include "methods/contract/method.h"

namespace dustbench::null_method {

/// Draws 1000 random numbers a unit on one thread and gives their sum, so that no compiler leaves them out.
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

/// What the method declares; the registry asks for it.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::null_method
