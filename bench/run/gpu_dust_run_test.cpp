// Runs whose dust lives on the GPU: the states, pictures and metrics of the runs with dust on the CPU.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "bench/measure/image/picture_error.h"
#include "bench/run/frame_runner.h"
#include "bench/run/measured_run.h"
#include "bench/run/method_host.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/gpu/faulty_driver.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::run {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class GpuDustRun : public testing::Test {
 protected:
    [[nodiscard]] static results::RunSpec specOf(const std::string& method, results::DustOn place,
                                                 const results::ParameterTexts& parameters = {},
                                                 const std::string& scene = "plain") {
        results::RunSpec spec;
        spec.method = method;
        spec.scene = scene;
        spec.dustOn = place;
        spec.drive = "figure_of_eight";
        spec.size = {160, 120};
        spec.frames = 31;
        spec.warmup = 2;
        spec.parameters = results::canonicalParameters(findMethod(method), parameters);
        return spec;
    }
    [[nodiscard]] results::RunRecord measured(const results::RunSpec& spec) const {
        return measureRun(spec, folder_.path(), {}, [](std::string_view, std::int64_t, std::int64_t) {});
    }
    [[nodiscard]] static double asDouble(const results::Value& value) {
        if (const auto* number = std::get_if<double>(&value)) return *number;
        if (const auto* number = std::get_if<std::int64_t>(&value)) return static_cast<double>(*number);
        ADD_FAILURE() << "not a number";
        return 0;
    }
    [[nodiscard]] static double numberOf(const results::RunRecord& record, std::string_view column) {
        for (const auto& [name, value] : record.summary)
            if (name == column) return asDouble(value);
        ADD_FAILURE() << "no " << column;
        return 0;
    }
    [[nodiscard]] static bool hasMethod(std::string_view id) {
        return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
    }

    TestFolder folder_;
};

/// One world and runner.
struct Stepped {
    Stepped(const results::RunSpec& spec, gpu::Device& device)
        : parameters(results::resolveParameters(findMethod(spec.method), spec.parameters)),
          world(spec.scene, spec.drive, parameters.world, spec.seed),
          runner(spec, world, device, parameters.method, false) {
        (void)placeDust(spec, world, device);
    }

    results::ResolvedParameters parameters;
    world::World world;
    FrameRunner runner;
};

/// Methods that take the buffers, and the numbers of a frame that only the GPU knows. Without those that read their
/// pixels' counters: linked_list, and on a software renderer all with a LoopLimit.
struct Taker {
    const char* method;
    results::ParameterTexts parameters{};
    int numbers = 1;  ///< particles, and primitives if there is not one for each particle
};
const std::vector<Taker> takers{{"billboard"},
                                {"billboard", {{"raster", "tiles"}}},
                                {"offscreen_particles"},
                                {"stochastic_transparency"},
                                {"weighted_oit"},
                                {"weighted_oit", {{"raster", "tiles"}}},
                                {"moment_oit"},
                                {"wavelet_oit"},
                                {"null_method"},
                                {"octree_recursive", {{"layout", "gpu"}}, 2},
                                {"octree_search", {{"layout", "gpu"}, {"render", "cubes"}}, 2}};

TEST_F(GpuDustRun, ReadsNothingBackInAFrame) {
    gpu::Device device;
    for (const auto& [method, parameters, numbers] : takers) {
        if (!hasMethod(method)) continue;
        results::RunSpec spec = specOf(method, results::DustOn::gpu, parameters);
        spec.sync = results::Sync::none;
        Stepped stepped(spec, device);
        for (int index = -40; index < -2; ++index) stepped.runner.stepWithoutPicture(index);
        stepped.runner.verifiedStep(-2);
        const gpu::CountedReadBacks readBacks;
        for (int index = -1; index < 20; ++index) stepped.runner.frame(index);
        EXPECT_EQ(readBacks.count(), 0) << method;
        stepped.runner.drain();
        EXPECT_EQ(readBacks.count(), 20 * numbers) << method << ": the numbers of each frame, afterwards";
        for (const measure::FrameRecord& frame : stepped.runner.records()) {
            EXPECT_GT(frame.particles, 100) << method;
            if (numbers == 2) {
                EXPECT_GT(frame.primitives, 20) << method;
                EXPECT_LT(frame.primitives, frame.particles) << method;
            }
        }
    }
}

/// How often a method draws each particle in a frame.
int passesOf(const std::string& method, const results::ParameterTexts& parameters) {
    static const std::map<std::string, int> passes{
        {"stochastic_transparency", 2}, {"moment_oit", 2}, {"wavelet_oit", 2}};
    const auto found = passes.find(method);
    return (found == passes.end() ? 1 : found->second) + (parameters.contains("bounds") ? 1 : 0);
}

TEST_F(GpuDustRun, DrawsThePictureOfDustOnTheCpu) {
    gpu::Device device;
    const std::vector<std::pair<std::string, results::ParameterTexts>> settings{
        {"billboard", {}},
        {"billboard", {{"soft", "on"}, {"facing", "viewplane"}}},
        {"billboard", {{"sort", "none"}}},
        {"billboard", {{"raster", "tiles"}}},
        {"weighted_oit", {}},
        {"weighted_oit", {{"raster", "tiles"}}},
        {"weighted_oit", {{"mode", "paper"}}},
        {"moment_oit", {}},
        {"moment_oit", {{"mode", "paper"}, {"warp", "linear"}}},
        {"moment_oit", {{"precision", "quantised"}}},
        {"wavelet_oit", {}},
        {"wavelet_oit", {{"puff", "volume"}, {"warp", "linear"}}},
        {"wavelet_oit", {{"bounds", "pixel"}}},
        {"multi_layer", {}},
        {"offscreen_particles", {}},
        {"stochastic_transparency", {}},
        {"adaptive_transparency", {}},
        {"linked_list", {{"fragments_per_pixel", "256"}}}};
    for (const char* scene : {"plain", "two_soils"})
        for (const auto& [method, parameters] : settings) {
            if (!hasMethod(method)) continue;
            std::vector<pictures::Image> shown;
            for (const results::DustOn place : {results::DustOn::cpu, results::DustOn::gpu}) {
                Stepped stepped(specOf(method, place, parameters, scene), device);
                for (int index = -120; index < -1; ++index) stepped.runner.stepWithoutPicture(index);
                stepped.runner.verifiedStep(-1);
                stepped.runner.frame(0);
                shown.push_back(stepped.runner.picture());
                const measure::FrameRecord& last = stepped.runner.records().back();
                EXPECT_GT(last.particles, 500) << method;
                EXPECT_EQ(last.primitives, passesOf(method, parameters) * last.particles) << method;
            }
            const double difference =
                *measure::flip(measure::preparePicture(shown[0], "CPU"), measure::preparePicture(shown[1], "GPU"))
                     .value;
            EXPECT_LT(difference, 1e-3) << method << " in " << scene;
        }
}

/// Octrees that the GPU builds, from dust on either side, against those of the CPU.
TEST_F(GpuDustRun, HasTheOctreesOfTheCpu) {
    gpu::Device device;
    for (const char* method : {"octree_recursive", "octree_search"})
        for (const char* scene : {"plain", "two_soils"})
            for (const char* policy : {"max", "accumulate"}) {
                if (!hasMethod(method)) continue;
                std::vector<pictures::Image> shown;
                std::vector<std::int64_t> voxels;
                std::vector<results::Columns> facts;
                for (const auto& [layout, place] :
                     {std::pair("faithful", results::DustOn::cpu), std::pair("gpu", results::DustOn::cpu),
                      std::pair("gpu", results::DustOn::gpu)}) {
                    Stepped stepped(specOf(method, place, {{"layout", layout}, {"policy", policy}}, scene), device);
                    for (int index = -120; index < -1; ++index) stepped.runner.stepWithoutPicture(index);
                    stepped.runner.verifiedStep(-1);
                    stepped.runner.frame(0);
                    shown.push_back(stepped.runner.picture());
                    stepped.runner.drain();
                    voxels.push_back(stepped.runner.records().back().primitives);
                    facts.push_back(stepped.runner.facts());
                    ASSERT_EQ(facts.back().size(), facts.front().size());
                    for (std::size_t i = 0; i < facts.front().size(); ++i) {
                        const auto& [name, value] = facts.front()[i];
                        EXPECT_EQ(facts.back()[i].first, name);
                        if (name == "structure_bytes") continue;  // the GPU has no nodes
                        EXPECT_NEAR(asDouble(facts.back()[i].second), asDouble(value), 1e-6) << name;
                    }
                }
                EXPECT_GT(voxels[0], 100);
                EXPECT_EQ(voxels[1], voxels[0]) << method << " in " << scene;
                EXPECT_EQ(voxels[2], voxels[0]) << method << " in " << scene;
                for (const std::size_t built : {1, 2})
                    EXPECT_LT(*measure::flip(measure::preparePicture(shown[0], "CPU"),
                                             measure::preparePicture(shown[built], "GPU"))
                                   .value,
                              1e-3)
                        << method << " in " << scene << ", " << policy;
            }
}

TEST_F(GpuDustRun, IsReadBackInTheUploadForOtherMethods) {
    for (const auto& [method, parameters] : std::vector<std::pair<std::string, results::ParameterTexts>>{
             {"billboard", {{"sort", "quicksort"}}}, {"octree_search", {}}}) {
        if (!hasMethod(method)) continue;
        const results::RunRecord cpu = measured(specOf(method, results::DustOn::cpu, parameters));
        const results::RunRecord gpu = measured(specOf(method, results::DustOn::gpu, parameters));
        EXPECT_EQ(gpu.provenance.dustOn.place, "gpu");
        EXPECT_EQ(cpu.provenance.dustOn.place, "cpu");
        EXPECT_THAT(gpu.provenance.warnings, Contains(HasSubstr("reads the dust back"))) << method;
        EXPECT_THAT(cpu.provenance.warnings, Not(Contains(HasSubstr("reads the dust back")))) << method;
        EXPECT_EQ(numberOf(gpu, "particles_median"), numberOf(cpu, "particles_median")) << method;
        EXPECT_EQ(numberOf(gpu, "primitives_median"), numberOf(cpu, "primitives_median")) << method;
        EXPECT_NE(results::runId(gpu.spec), results::runId(cpu.spec));
    }
}

TEST_F(GpuDustRun, IsReplayedAndJudgedAsOnTheCpu) {
    if (!hasMethod("billboard")) GTEST_SKIP() << "no billboards here";
    std::vector<results::RunRecord> runs;
    for (const results::DustOn place : {results::DustOn::cpu, results::DustOn::gpu}) {
        results::RunSpec spec = specOf("billboard", place, {{"soft", "on"}, {"particles", "600"}});
        spec.metricPlan.emplace();
        runs.push_back(measured(spec));
    }
    EXPECT_GT(numberOf(runs[1], "psnr_db"), 60);
    for (const char* metric : {"psnr_db", "ssim", "flip", "popping", "gaps", "quads_per_pixel", "volume_error"})
        EXPECT_NEAR(numberOf(runs[1], metric), numberOf(runs[0], metric), 1e-3 * (1 + numberOf(runs[0], metric)))
            << metric;
    EXPECT_THAT(runs[1].provenance.warnings, Not(Contains(HasSubstr("reads the dust back"))));
}

TEST_F(GpuDustRun, StaysOnTheCpuOfASoftwareDeviceUnlessRequested) {
    gpu::Device device;
    if (!device.isSoftware()) GTEST_SKIP() << "a hardware device";
    Stepped stepped(specOf("null_method", results::DustOn::automatic), device);
    EXPECT_EQ(stepped.world.gpuDust(), nullptr);
}

TEST_F(GpuDustRun, IsRefusedForPartsWithoutAShader) {
    const results::RunSpec spec = specOf("null_method", results::DustOn::gpu, {}, "smoke");
    EXPECT_THROW((void)measured(spec), InputError);
    EXPECT_NO_THROW((void)measured(specOf("null_method", results::DustOn::automatic, {}, "smoke")));
}

}  // namespace
}  // namespace dustbench::run
