#include "methods/kit/draw/loop_limit.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::draw {

LoopLimit::LoopLimit(gpu::Device& device)
    : device_(device), unfinished_(device, "unfinished pixels", sizeof(std::uint32_t)) {}

void LoopLimit::bind(gpu::Program& program) {
    constexpr int moreThanOne = 4;
    program.set("probeIterations", moreThanOne);
    unfinished_.bindStorage(6);
}

void LoopLimit::requireWholeLoops(std::string_view method) const {
    if (!device_.isSoftware()) return;
    std::array<std::uint32_t, 1> pixels{};
    unfinished_.read(std::span<std::uint32_t>(pixels));
    if (pixels[0] > 0)
        throw InputError(std::string(method) +
                         ": got too many puffs in a pixel for this driver, which ends the loops of a shader after "
                         "65,535 iterations; use fewer "
                         "particles, or a GPU");
}

}  // namespace dustbench::draw
