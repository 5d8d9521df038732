#include "bench/measure/energy.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace dustbench::measure {
namespace {
namespace fs = std::filesystem;

/// A folder like /sys/class/powercap.
class Powercap : public testing::Test {
 protected:
    void SetUp() override {
        fs::remove_all(root_);
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    void zone(const std::string& folder, const std::string& name, long long microjoules, long long range = 999'999) {
        fs::create_directories(root_ / folder);
        std::ofstream(root_ / folder / "name") << name << "\n";
        std::ofstream(root_ / folder / "max_energy_range_uj") << range << "\n";
        std::ofstream(root_ / folder / "energy_uj") << microjoules << "\n";
    }

    const fs::path root_ = fs::path(testing::TempDir()) / ("dustbench_powercap_" + std::to_string(getpid()));
};

TEST_F(Powercap, SumsPackagesAndNothingThatIsPartOfOne) {
    const auto write = [&](long long first, long long second) {
        zone("intel-rapl:0", "package-0", first);
        zone("intel-rapl:1", "package-1", second);
        zone("intel-rapl:0:0", "core", 10 * first);
        zone("intel-rapl:2", "psys", 10 * first);
        zone("intel-rapl-mmio:0", "package-0", first);
    };
    write(100, 200);
    const auto counter = packageEnergy(root_);
    ASSERT_TRUE(counter);
    const double begin = counter->joules();
    write(100 + 3000, 200 + 500);
    EXPECT_DOUBLE_EQ(counter->joules() - begin, 3500e-6);
}

TEST_F(Powercap, CountsOnWhereACounterStartsAgain) {
    zone("intel-rapl:0", "package-0", 999'900);
    const auto counter = packageEnergy(root_);
    ASSERT_TRUE(counter);
    const double begin = counter->joules();
    zone("intel-rapl:0", "package-0", 100);
    EXPECT_NEAR(counter->joules() - begin, 200e-6, 1e-12);
}

TEST_F(Powercap, IsMissingWhereTheMachineDoesNotTell) {
    EXPECT_FALSE(packageEnergy(root_));
    EXPECT_FALSE(packageEnergy(root_ / "nowhere"));
    zone("intel-rapl:0", "package-0", 100);
    std::ofstream(root_ / "intel-rapl:0" / "energy_uj") << "";
    EXPECT_FALSE(packageEnergy(root_));
}

TEST_F(Powercap, AMeterLeavesOutWhatHappensWhilePaused) {
    zone("intel-rapl:0", "package-0", 0);
    EnergyMeter meter(packageEnergy(root_), nullptr);
    for (const long long at : {1000, 100'000}) {
        zone("intel-rapl:0", "package-0", at);
        meter.resume();
        zone("intel-rapl:0", "package-0", at + 50);
        meter.pause();
    }
    EXPECT_NEAR(*meter.cpuJoules(), 100e-6, 1e-12);
    EXPECT_FALSE(meter.gpuJoules());
}

TEST_F(Powercap, ACounterThatVanishesIsAnError) {
    zone("intel-rapl:0", "package-0", 0);
    const auto counter = packageEnergy(root_);
    fs::remove_all(root_ / "intel-rapl:0");
    EXPECT_THROW((void)counter->joules(), std::runtime_error);
}

TEST(GpuEnergy, CountsTheGpuThatDraws) {
    const auto counter = gpuEnergy("Stand-in Two/PCIe/SSE2", NVML_STAND_IN);
    ASSERT_TRUE(counter);
    const double begin = counter->joules();
    EXPECT_DOUBLE_EQ(counter->joules() - begin, 1.5);
}

TEST(GpuEnergy, IsMissingForOtherRenderersTwoOfANameAndWithoutTheLibrary) {
    EXPECT_FALSE(gpuEnergy("llvmpipe (LLVM 15.0.6, 256 bits)", NVML_STAND_IN));
    EXPECT_FALSE(gpuEnergy("Stand-in One and Stand-in Two", NVML_STAND_IN));
    EXPECT_FALSE(gpuEnergy("Stand-in One", "libno-such-library.so.1"));
}

}  // namespace
}  // namespace dustbench::measure
