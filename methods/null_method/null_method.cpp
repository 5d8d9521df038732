#include "methods/null_method/null_method.h"

#include "methods/kit/maths/philox.h"

namespace dustbench::null_method {
namespace {

constexpr std::uint64_t numbersPerUnit = 1000;

}  // namespace

std::uint32_t fixedWork(std::uint64_t units) {
    std::uint32_t sum = 0;
    for (std::uint64_t serial = 0; serial < units * numbersPerUnit; ++serial)
        sum += maths::randomWords(0, 0, serial)[0];
    return sum;
}

void NullMethod::update(const Frame&) {
    workDone_ = fixedWork(work_);
}

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
