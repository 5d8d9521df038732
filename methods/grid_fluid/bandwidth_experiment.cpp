// Measures the cost of more arithmetic and of more memory traffic on a device (claim R27).
//
// A kernel reads 16 bytes per thread, computes with them and writes 16 bytes, over arrays larger than any cache. Its
// time is compared with that of twice the arithmetic on the same bytes, and of the same arithmetic with twice the
// bytes. The arithmetic is an interpolation of four values between eight cells, 4 × 7 × 2 multiply-adds. MacCormack
// performs it twice, semi-Lagrangian advection once.
//
// Threads: that of the device. Source: Senger2009, 4.1.2.
#include <array>
#include <chrono>
#include <glm/glm.hpp>
#include <string>

#include "grid_fluid_shaders.h"
#include "methods/contract/experiment.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::grid_fluid::bandwidth {
namespace {

constexpr int threadsPerGroup = 256;

class StreamKernels {
 public:
    StreamKernels(gpu::Device& device, int groups) : device_(device), groups_(groups) {
        const std::size_t bytes = static_cast<std::size_t>(groups) * threadsPerGroup * sizeof(glm::vec4);
        for (gpu::Buffer& array : arrays_) {
            array = gpu::Buffer(device, "bandwidth", bytes);
            array.clear();
        }
    }

    [[nodiscard]] gpu::Program kernel(int streams, int operations) {
        gpu::Program program(device_, "bandwidth", {grid_fluid_shaders::bandwidth_comp},
                             {{"STREAMS", std::to_string(streams)}, {"OPERATIONS", std::to_string(operations)}});
        program.set("factor", glm::vec4(0.5f, 0.25f, 0.75f, 0.125f));
        return program;
    }

    [[nodiscard]] double secondsOf(const gpu::Program& program) {
        for (std::uint32_t i = 0; i < arrays_.size(); ++i) arrays_[i].bindStorage(i);
        device_.finish();
        const auto begin = std::chrono::steady_clock::now();
        program.dispatch(groups_, 1, 1);
        device_.finish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

 private:
    gpu::Device& device_;
    int groups_;
    std::array<gpu::Buffer, 4> arrays_;
};

struct CostRatios {
    std::vector<double> both, arithmetic, bytes;
};

CostRatios ratiosOf(StreamKernels& streams, int operations, int rounds) {
    const gpu::Program plain = streams.kernel(1, operations), moreArithmetic = streams.kernel(1, 2 * operations),
                       moreBytes = streams.kernel(2, operations);
    CostRatios ratios;
    for (int round = -1; round < rounds; ++round) {  // the first warms up
        const double ofPlain = streams.secondsOf(plain), ofArithmetic = streams.secondsOf(moreArithmetic),
                     ofBytes = streams.secondsOf(moreBytes);
        if (round < 0) continue;
        ratios.both.push_back(ofArithmetic / ofBytes);
        ratios.arithmetic.push_back(ofArithmetic / ofPlain);
        ratios.bytes.push_back(ofBytes / ofPlain);
    }
    return ratios;
}

std::vector<Finding> measureCosts(ExperimentContext& context) {
    constexpr int ofLookUp = 4 * 7 * 2, ofLongComputation = 500;
    StreamKernels streams(context.device(), context.quick() ? 1 << 13 : 1 << 14);
    const int rounds = context.quick() ? 9 : 25;
    const CostRatios ratios = ratiosOf(streams, ofLookUp, rounds);
    return {findings::medianOf("arithmetic", ratios.both), findings::medianOf("arithmetic_alone", ratios.arithmetic),
            findings::medianOf("bytes_alone", ratios.bytes),
            findings::medianOf("control_compute", ratiosOf(streams, ofLongComputation, 3).both),
            findings::medianOf("control_copy", ratiosOf(streams, 1, rounds).both)};
}

}  // namespace

/// The experiment `bandwidth`, by OpenGL. Medians over rounds:
///     arithmetic    time with twice the arithmetic / with twice the bytes
///     arithmetic_alone, bytes_alone   each divided by the time without either
///     control_compute   as `arithmetic`, with so much arithmetic per thread that its bytes do not matter
///     control_copy      as `arithmetic`, with one operation per thread
ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures whether doubling the arithmetic or doubling the memory traffic slows a device down more.";
    info.source = "Senger2009";
    info.run = measureCosts;
    return info;
}

}  // namespace dustbench::grid_fluid::bandwidth
