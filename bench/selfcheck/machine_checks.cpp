#include "bench/selfcheck/machine_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <span>

#include "bench_selfcheck_shaders.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/queue_marks.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::selfcheck {

std::vector<Check> machineChecks(const measure::Provenance& provenance) {
    constexpr double coarseNs = 1000;
    const double readingNs = provenance.clock.readingNs;
    std::vector<Check> checks{{"clock", readingNs < coarseNs ? Outcome::ok : Outcome::attention,
                               fmt::format("{:.0f} ns per reading", readingNs), fmt::format("below {} ns", coarseNs)}};
    for (const std::string& disturbance : measure::disturbances(provenance.machine))
        checks.push_back({"machine", Outcome::attention, disturbance, ""});
    return checks;
}

Check throttlingCheck(const measure::Machine& before, const measure::Machine& after) {
    const auto events = after.throttled - before.throttled;
    return {"throttling", events > 0 ? Outcome::attention : Outcome::ok, fmt::format("{} events", events), "none",
            events > 0 ? "the processor became too hot: times vary" : ""};
}

Check gpuClockCheck(const GpuClockReadings& readings) {
    if (!readings.before || !readings.during || !readings.after)
        return {"GPU clock", Outcome::ok, "not reported", "", "read by NVML on NVIDIA's GPUs"};
    const auto& [before, during, after] = readings;
    Check check{
        "GPU clock", Outcome::ok,
        fmt::format("{} MHz before, {} under load, {} after", before->megahertz, during->megahertz, after->megahertz),
        "no fall under load"};
    if (!during->throttledBy.empty()) {
        check.outcome = Outcome::attention;
        check.note = "limited by: " + during->throttledBy;
    } else if (during->megahertz < before->megahertz) {
        check.outcome = Outcome::attention;
        check.note = "the clock falls under load: times vary";
    }
    return check;
}

namespace {

namespace shaders = bench_selfcheck_shaders;

Outcome failedUnless(bool right) {
    return right ? Outcome::ok : Outcome::failed;
}

/// Layers drawn over each other into one target, the first at the bottom.
std::vector<float> blended(gpu::Device& device, gpu::Format format, std::span<const glm::vec4> layers) {
    constexpr int side = 16;
    const gpu::Texture target = gpu::Texture::make2D(device, "selfcheck target", format, side, side);
    const gpu::Framebuffer framebuffer(device, "selfcheck target", &target, nullptr);
    const gpu::Program program(device, "selfcheck blending", {shaders::covering_vert, shaders::flat_colour_frag});
    const gpu::Buffer colours(device, "selfcheck layers", layers);
    gpu::VertexArray vertices(device);
    vertices.attribute(0, 4, colours, sizeof(glm::vec4), 0, gpu::Advance::perInstance);
    framebuffer.clearColour(0, 0, 0, 0);
    framebuffer.bind();
    gpu::draw(program, vertices, {.blend = gpu::Blend::premultiplied}, gpu::Primitives::triangles, 3,
              static_cast<int>(layers.size()));
    return target.readFloats();
}

/// Largest difference of any pixel from the same layers blended on the CPU; infinite if a pixel is not a number.
double blendingError(std::span<const float> pixels, std::span<const glm::vec4> layers) {
    glm::vec4 expected(0);
    for (const glm::vec4& layer : layers) expected = layer + (1 - layer.a) * expected;
    double error = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto channel = static_cast<glm::length_t>(i % 4);
        const double difference = std::abs(static_cast<double>(pixels[i]) - static_cast<double>(expected[channel]));
        if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
        error = std::max(error, difference);
    }
    return error;
}

/// Strong layers in saturated colours: in another order the result differs by tenths.
Check blendingOrder(gpu::Device& device) {
    std::vector<glm::vec4> layers;
    for (int i = 0; i < 48; ++i) {
        const float alpha = 0.25f + 0.05f * static_cast<float>(i % 7);
        layers.emplace_back(i % 3 == 0 ? alpha : 0, i % 3 == 1 ? alpha : 0, i % 3 == 2 ? alpha : 0, alpha);
    }
    const double error = blendingError(blended(device, gpu::Format::rgba32F, layers), layers);
    return {"blending order", failedUnless(error < 0.02), fmt::format("off by {:.2g}", error), "below 0.02",
            "layers are blended in the order in which they are drawn"};
}

/// Equal thin layers: their order does not matter, but fewer bits lose them.
Check floatTargets(gpu::Device& device) {
    const std::vector<glm::vec4> layers(1500, glm::vec4(0.002f));
    const double error = blendingError(blended(device, gpu::Format::rgba32F, layers), layers);
    return {"float targets", failedUnless(error < 1e-4), fmt::format("off by {:.2g}", error), "below 1e-4",
            "1,500 layers with alpha 0.002 in RGBA32F"};
}

Check halfTargets(gpu::Device& device) {
    double worst = 0;
    for (const float value : {1e-3f, 0.1f, 0.7f, 3.3f, 1000.3f}) {
        const std::array layer{glm::vec4(value, value, value, 1)};
        const double error = blendingError(blended(device, gpu::Format::rgba16F, layer), layer);
        worst = std::max(worst, error / static_cast<double>(value));
    }
    return {"half-float targets", failedUnless(worst <= 0x1p-10), fmt::format("relative error {:.2g}", worst),
            "at most 2^-10", "RGBA16F"};
}

Check atomics(gpu::Device& device) {
    constexpr std::uint32_t groups = 4096, count = groups * 64;
    gpu::Buffer counter(device, "selfcheck counter", sizeof(std::uint32_t));
    gpu::Buffer tickets(device, "selfcheck tickets", count * sizeof(std::uint32_t));
    counter.clear();
    tickets.clear();
    counter.bindStorage(0);
    tickets.bindStorage(1);
    const gpu::Program program(device, "selfcheck tickets", {shaders::tickets_comp});
    program.dispatch(groups, 1, 1);
    std::vector<std::uint32_t> owners(count);
    tickets.read(std::span(owners));
    std::uint32_t given = 0;
    counter.read(std::span(&given, 1));
    std::ranges::sort(owners);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < count; ++i) wrong += owners[i] != i ? 1 : 0;
    return {"atomics", failedUnless(wrong == 0 && given == count), fmt::format("{} of {} wrong", wrong, count),
            "0 wrong", "each invocation takes a unique ticket"};
}

Check barriers(gpu::Device& device) {
    constexpr std::uint32_t groups = 1024, count = groups * 64;
    constexpr int passes = 16;
    std::vector<std::uint32_t> expected(count);
    std::iota(expected.begin(), expected.end(), 0u);
    std::array<gpu::Buffer, 2> buffers{
        gpu::Buffer(device, "selfcheck reversal", std::span<const std::uint32_t>(expected)),
        gpu::Buffer(device, "selfcheck reversal", count * sizeof(std::uint32_t))};
    const gpu::Program program(device, "selfcheck reversal", {shaders::reversal_comp});
    for (std::size_t pass = 0; pass < passes; ++pass) {
        buffers[pass % 2].bindStorage(0);
        buffers[1 - pass % 2].bindStorage(1);
        program.dispatch(groups, 1, 1);
        std::vector<std::uint32_t> next(count);
        for (std::uint32_t i = 0; i < count; ++i)
            next[(i / 64 * 5 + 3) % groups * 64 + i % 64] = expected[i / 64 * 64 + 63 - i % 64] + 1;
        expected = std::move(next);
    }
    std::vector<std::uint32_t> found(count);
    buffers[passes % 2].read(std::span(found));
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < count; ++i) wrong += found[i] != expected[i] ? 1 : 0;
    return {"barriers", failedUnless(wrong == 0), fmt::format("{} of {} wrong", wrong, count), "0 wrong",
            "16 passes through shared and global memory"};
}

Check wideIntegers(gpu::Device& device) {
    if (!device.offers("GL_ARB_gpu_shader_int64"))
        return {"64-bit integers", Outcome::attention, "not supported", "GL_ARB_gpu_shader_int64",
                "shaders that need them are skipped"};
    constexpr std::uint64_t a = 0x9e3779b97f4a7c15, b = 0xbf58476d1ce4e5b9;
    const auto words = [](std::uint64_t value) {
        return std::array{static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(value >> 32)};
    };
    const std::array<std::uint32_t, 6> given{words(a)[0], words(a)[1], words(b)[0], words(b)[1], 0, 0};
    gpu::Buffer buffer(device, "selfcheck words", std::span<const std::uint32_t>(given));
    buffer.bindStorage(0);
    const gpu::Program program(device, "selfcheck words", {shaders::wide_integers_comp});
    program.dispatch(1, 1, 1);
    std::array<std::uint32_t, 6> found{};
    buffer.read(std::span<std::uint32_t>(found));
    const std::uint64_t result = found[4] | static_cast<std::uint64_t>(found[5]) << 32;
    const std::uint64_t expected = a * b + (a >> 7) - (b << 3);
    return {"64-bit integers", failedUnless(result == expected), fmt::format("{:016x}", result),
            fmt::format("{:016x}", expected)};
}

Check timerQueries(gpu::Device& device) {
    const gpu::TimerComparison times = gpu::compareTimerWithFence(device);
    const std::string measured = fmt::format("{:.2f} ms, by fence {:.2f} ms", times.queryMs, times.fenceMs);
    const std::string expected = "within a factor of 2";
    if (times.agree()) return {"timer queries", Outcome::ok, measured, expected};
    return {"timer queries", device.isSoftware() ? Outcome::attention : Outcome::failed, measured, expected,
            "gpu_ms stays empty"};
}

/// Seconds of `work(n)`, best of three, with the n at which it takes at least 20 ms: work per second.
double perSecond(gpu::Device& device, const std::function<void(int)>& work) {
    const auto secondsOf = [&](int amount) {
        device.finish();
        const auto begin = std::chrono::steady_clock::now();
        work(amount);
        device.finish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    int amount = 1;
    while (secondsOf(amount) < 0.02 && amount < 1 << 20) amount *= 2;
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round) best = std::min(best, secondsOf(amount));
    return amount / best;
}

}  // namespace

std::vector<Check> correctnessChecks(gpu::Device& device) {
    return {blendingOrder(device), floatTargets(device), halfTargets(device), atomics(device),
            barriers(device),      wideIntegers(device), timerQueries(device)};
}

DeviceRates measureRates(gpu::Device& device, const std::function<void()>& underLoad) {
    constexpr int side = 512, pixels = side * side;
    DeviceRates rates;
    const gpu::Texture target = gpu::Texture::make2D(device, "selfcheck target", gpu::Format::rgba32F, side, side);
    const gpu::Framebuffer framebuffer(device, "selfcheck target", &target, nullptr);
    const std::vector<glm::vec4> colours(1024, glm::vec4(0.01f));
    const gpu::Buffer layers(device, "selfcheck layers", std::span<const glm::vec4>(colours));
    gpu::VertexArray vertices(device);
    vertices.attribute(0, 4, layers, sizeof(glm::vec4), 0, gpu::Advance::perInstance);

    framebuffer.clearColour(0, 0, 0, 0);
    framebuffer.bind();
    const gpu::Program fill(device, "selfcheck fill", {shaders::covering_vert, shaders::flat_colour_frag});
    const auto blend = [&](int times) {
        for (int drawn = 0; drawn < times; drawn += 1024)
            gpu::draw(fill, vertices, {.blend = gpu::Blend::premultiplied}, gpu::Primitives::triangles, 3,
                      std::min(times - drawn, 1024));
    };
    rates.blendedGigapixels = perSecond(device, blend) * pixels * 1e-9;

    constexpr int rounds = 256;
    gpu::Program inCompute(device, "selfcheck arithmetic", {shaders::arithmetic_glsl, shaders::arithmetic_comp});
    gpu::Program inFragment(device, "selfcheck arithmetic",
                            {shaders::arithmetic_glsl, shaders::covering_vert, shaders::arithmetic_frag});
    inCompute.set("rounds", rounds);
    inFragment.set("rounds", rounds);
    const std::vector<float> start(pixels, 0.25f);
    const gpu::Buffer values(device, "selfcheck arithmetic", std::span<const float>(start));
    values.bindStorage(0);
    const auto compute = [&](int times) {
        for (int i = 0; i < times; ++i) inCompute.dispatch(pixels / 64, 1, 1);
    };
    const double computed = perSecond(device, compute);
    compute(static_cast<int>(computed * 0.1) + 1);  // a tenth of a second
    underLoad();
    const double shaded = perSecond(device, [&](int times) {
        for (int i = 0; i < times; ++i) gpu::draw(inFragment, vertices, {}, gpu::Primitives::triangles, 3);
    });
    rates.gigaflops = computed * pixels * 2.0 * rounds * 1e-9;
    rates.fragmentShare = shaded / computed;

    constexpr int megabytes = 32, elements = megabytes * (1 << 20) / 16;
    const gpu::Buffer from(device, "selfcheck copy", std::size_t{megabytes} << 20);
    const gpu::Buffer to(device, "selfcheck copy", std::size_t{megabytes} << 20);
    from.bindStorage(0);
    to.bindStorage(1);
    const gpu::Program copy(device, "selfcheck copy", {shaders::copy_comp});
    const double copies = perSecond(device, [&](int times) {
        for (int i = 0; i < times; ++i) copy.dispatch(elements / 64, 1, 1);
    });
    rates.copiedGigabytes = copies * 2.0 * static_cast<double>(std::size_t{megabytes} << 20) * 1e-9;
    return rates;
}

std::vector<Check> rateChecks(const DeviceRates& rates, bool isSoftware) {
    constexpr double slow = 0.25;  // GPUs made for drawing reach 0.8 to 1; an H100 about 0.03
    const bool misleads = !isSoftware && rates.fragmentShare < slow;
    return {{"fill rate", Outcome::ok, fmt::format("{:.3g} Gpixel/s", rates.blendedGigapixels), "", "blended, RGBA32F"},
            {"arithmetic", Outcome::ok, fmt::format("{:.3g} GFLOP/s", rates.gigaflops), "", "compute shader"},
            {"fragment shaders", misleads ? Outcome::attention : Outcome::ok,
             fmt::format("{:.2f} of the arithmetic rate", rates.fragmentShare), fmt::format("at least {}", slow),
             misleads ? "this GPU is not made for drawing: its frame rates do not carry over to GPUs that are" : ""},
            {"memory", Outcome::ok, fmt::format("{:.3g} GB/s", rates.copiedGigabytes), "",
             "compute shader, read plus written"}};
}

}  // namespace dustbench::selfcheck
