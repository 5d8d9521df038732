// A method that draws nothing: it measures the baseline cost of a frame, plus a load of known size to validate timing.
#include <cstdint>

#include "methods/contract/method.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::null_method {
namespace {

constexpr std::uint64_t numbersPerUnit = 1000;

/// Returns the sum of 1000 random numbers per unit, drawn on one thread, so that the compiler cannot drop the work.
std::uint32_t fixedWork(std::uint64_t units) {
    std::uint32_t sum = 0;
    for (std::uint64_t serial = 0; serial < units * numbersPerUnit; ++serial)
        sum += maths::randomWords(0, 0, serial)[0];
    return sum;
}

class NullMethod final : public Method {
 public:
    explicit NullMethod(std::uint64_t work) : work_(work) {}

    void prepare(const scene::Scene&, const RunSetup&, gpu::Device&) override {}
    void update(const Frame&) override { workDone_ = fixedWork(work_); }
    void draw(const Frame&, gpu::Layer&) override {}

 private:
    std::uint64_t work_;
    volatile std::uint32_t workDone_ = 0;
};

}  // namespace

/// Called by the registry.
MethodInfo describe() {
    MethodInfo info;
    info.title = "Null method";
    info.summary = "Draws nothing: a frame contains only the world, the opaque scene and the harness.";
    info.takesLights = true;
    info.parameters
        .integer("work", 0, 0, 1'000'000, "units", "1000 random numbers each, drawn in `build`: a load of known size")
        .choice("entry", "first", {"first", "second"},
                "no effect: runs the same method under two names, which a comparison must report as equal");
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<NullMethod>(static_cast<std::uint64_t>(values.integer("work")));
    };
    return info;
}

}  // namespace dustbench::null_method
