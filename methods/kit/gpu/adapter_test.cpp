// Tests the choice of adapter on simulated machines.
#include "methods/kit/gpu/adapter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench::gpu {
namespace {

using testing::HasSubstr;
using Kind = Adapter::Kind;
using Platform = Adapter::Platform;

Adapter device(const std::string& name, Kind kind, const std::string& problem = "") {
    return {.name = name, .kind = kind, .platform = Platform::device, .problem = problem};
}

/// Appends the surfaceless platform to the devices and numbers them.
std::vector<Adapter> machine(std::vector<Adapter> devices) {
    devices.push_back({.name = "surfaceless", .kind = Kind::software, .platform = Platform::surfaceless});
    for (std::size_t i = 0; i < devices.size(); ++i) devices[i].index = static_cast<int>(i);
    return devices;
}

/// The choice as text: the name and the reason.
std::string taken(const std::vector<Adapter>& adapters) {
    const auto preferred = preferredAdapter(adapters);
    return preferred ? adapters[*preferred].name + ", " + whyPreferred(adapters, *preferred) : "none";
}

}  // namespace

TEST(Adapter, HardwareIsTakenBeforeSoftwareWhereverItStands) {
    const Adapter gpu = device("gpu", Kind::hardware), llvmpipe = device("llvmpipe", Kind::software);
    EXPECT_EQ(taken(machine({llvmpipe, gpu})), "gpu, first hardware adapter");
    EXPECT_EQ(taken(machine({gpu, llvmpipe})), "gpu, first hardware adapter");
    EXPECT_EQ(taken(machine({gpu, device("second gpu", Kind::hardware)})), "gpu, first hardware adapter");
}

TEST(Adapter, WithoutHardwareItIsSurfacelessAndASoftwareDeviceAtLast) {
    const Adapter llvmpipe = device("llvmpipe", Kind::software);
    EXPECT_EQ(taken(machine({llvmpipe})), "surfaceless, no hardware adapter: surfaceless");
    EXPECT_EQ(taken(machine({})), "surfaceless, no hardware adapter: surfaceless");
    EXPECT_EQ(taken({llvmpipe}), "llvmpipe, no hardware adapter: software device");
    EXPECT_EQ(taken({}), "none");
    std::vector<Adapter> drawsOnAGpu = machine({});  // as its context has shown
    drawsOnAGpu[0].kind = Kind::hardware;
    EXPECT_EQ(taken(drawsOnAGpu), "surfaceless, EGL lists no hardware device: surfaceless");
    std::vector<Adapter> useless = machine({device("gpu", Kind::hardware)});
    for (Adapter& adapter : useless) adapter.problem = "has no display";
    EXPECT_EQ(taken(useless), "none");
}

TEST(Adapter, WhatIsCalledHardwareAndDrawnByTheCpuIsNotTakenForHardware) {
    std::vector<Adapter> adapters =
        machine({device("no driver", Kind::hardware), device("old", Kind::hardware), device("gpu", Kind::hardware)});
    std::vector<std::string> tried;
    const auto open = [&](Adapter& adapter) {
        tried.push_back(adapter.name);
        if (adapter.name == "no driver") adapter.kind = Kind::software;
        if (adapter.name == "old") adapter.problem = "provides no OpenGL 4.5";
    };
    EXPECT_EQ(takePreferred(adapters, open), 2u);
    EXPECT_THAT(tried, testing::ElementsAre("no driver", "old", "gpu"));
    adapters = machine({device("no driver", Kind::hardware), device("old", Kind::hardware)});
    tried.clear();
    EXPECT_EQ(takePreferred(adapters, open), 2u);
    EXPECT_THAT(tried, testing::ElementsAre("no driver", "old", "surfaceless"));
    adapters = {device("no driver", Kind::hardware)};
    tried.clear();
    EXPECT_EQ(takePreferred(adapters, open), 0u) << "all that there is";
}

TEST(Adapter, SaysWhichHardwareCouldNotBeTaken) {
    const Adapter broken = device("gpu", Kind::hardware, "has no display"), gpu = device("other", Kind::hardware);
    EXPECT_EQ(taken(machine({broken, gpu})),
              "other, first hardware adapter that provides OpenGL 4.5 (gpu has no display)");
    EXPECT_EQ(taken(machine({broken})),
              "surfaceless, no hardware adapter that provides OpenGL 4.5 (gpu has no display): surfaceless");
}

TEST(Adapter, IsFoundByIndexOrByAPartOfItsNameThatNoOtherHas) {
    const std::vector<Adapter> adapters =
        machine({device("NVIDIA GeForce RTX 4090 (/dev/dri/renderD128)", Kind::hardware),
                 device("NVIDIA GeForce RTX 4090 (/dev/dri/renderD129)", Kind::hardware),
                 device("llvmpipe (LLVM 15.0.6, 256 bits)", Kind::software), device("llvmpipe", Kind::software)});
    EXPECT_EQ(findAdapter(adapters, "0"), 0u);
    EXPECT_EQ(findAdapter(adapters, "4"), 4u);
    EXPECT_EQ(findAdapter(adapters, "RENDERd129"), 1u);
    EXPECT_EQ(findAdapter(adapters, "surf"), 4u);
    EXPECT_EQ(findAdapter(adapters, "llvmPIPE"), 3u) << "a whole name comes before a part of another";
    const auto refused = [&](const char* asked) { return inputError([&] { (void)findAdapter(adapters, asked); }); };
    for (const char* wrong : {"5", "15", "4090", "-1", "radeon"})
        EXPECT_THAT(refused(wrong), AllOf(HasSubstr(std::string("'") + wrong + "'"), HasSubstr("none of"),
                                          HasSubstr("3 llvmpipe, 4 surfaceless")));
    EXPECT_THAT(refused("rtx 4090"), AllOf(HasSubstr("several of"), HasSubstr("0 NVIDIA GeForce")));
}

TEST(Adapter, KnowsTheRenderersThatDrawOnTheCpu) {
    EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(isSoftwareRenderer("zink Vulkan 1.3(llvmpipe (LLVM 15.0.6, 256 bits))"));
    EXPECT_FALSE(isSoftwareRenderer("NVIDIA H200/PCIe/SSE2"));
}

}  // namespace dustbench::gpu
