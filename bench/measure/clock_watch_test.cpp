#include "bench/measure/clock_watch.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace dustbench::measure {
namespace {

using std::chrono::milliseconds;

/// Gives these readings, then can no longer be read.
class MadeClock final : public GpuClock {
 public:
    explicit MadeClock(std::vector<GpuClockReading> readings) : readings_(std::move(readings)) {}
    GpuClockReading read() override {
        if (next_ == readings_.size()) throw std::runtime_error("gone");
        return readings_[next_++];
    }

 private:
    std::vector<GpuClockReading> readings_;
    std::size_t next_ = 0;
};

ClockWatch watched(std::vector<GpuClockReading> readings) {
    const std::size_t count = readings.size();
    ClockWatch watch(std::make_unique<MadeClock>(std::move(readings)), milliseconds(0));
    for (std::size_t i = 0; i < count; ++i) watch.betweenFrames();
    return watch;
}

TEST(GpuClock, ReadsTheGpuThatDrawsAndWhatHoldsItDown) {
    const auto clock = gpuClock("Stand-in Two/PCIe/SSE2", NVML_STAND_IN);
    ASSERT_TRUE(clock);
    const GpuClockReading first = clock->read(), second = clock->read();
    EXPECT_EQ(first.megahertz - second.megahertz, 100u);
    EXPECT_EQ(first.throttledBy, "power cap, heat");
    EXPECT_EQ(gpuClock("Stand-in One", NVML_STAND_IN)->read().throttledBy, "") << "an idle GPU is not throttled";
    EXPECT_FALSE(gpuClock("llvmpipe (LLVM 15.0.6, 256 bits)", NVML_STAND_IN));
    EXPECT_FALSE(gpuClock("Stand-in One", "libno-such-library.so.1"));
}

TEST(ClockWatch, IsSilentWhileTheClockRisesOrMovesByAFewSteps) {
    const ClockWatch watch = watched({{900}, {1800}, {1770}, {1785}});
    EXPECT_EQ(watch.warning(), "");
    EXPECT_EQ(watch.range()->lowest, 900u);
    EXPECT_EQ(watch.range()->highest, 1800u);
}

TEST(ClockWatch, NamesAFallAndItsCause) {
    EXPECT_EQ(watched({{1800}, {1500}, {1790}}).warning(), "clock fell: the GPU's from 1800 to 1500 MHz");
    EXPECT_EQ(watched({{1800}, {1500, "heat"}}).warning(),
              "clock fell: the GPU's from 1800 to 1500 MHz, limited by heat");
    EXPECT_EQ(watched({{1800, "power cap"}, {1800}}).warning(), "clock fell: the GPU's is limited by power cap");
}

TEST(ClockWatch, SaysNothingWithoutAClockOrOnceItCannotBeRead) {
    ClockWatch none(nullptr);
    none.betweenFrames();
    none.end();
    EXPECT_FALSE(none.range());
    EXPECT_EQ(none.warning(), "");
    ClockWatch gone = watched({{1800}});
    gone.end();
    gone.end();
    EXPECT_EQ(gone.range()->lowest, 1800u);
    EXPECT_EQ(gone.warning(), "");
}

TEST(ClockWatch, ReadsNoMoreOftenThanItsInterval) {
    ClockWatch watch(std::make_unique<MadeClock>(std::vector<GpuClockReading>{{1800}, {900}}), std::chrono::hours(1));
    for (int i = 0; i < 10; ++i) watch.betweenFrames();
    EXPECT_EQ(watch.warning(), "");
    watch.end();
    EXPECT_EQ(watch.warning(), "clock fell: the GPU's from 1800 to 900 MHz");
}

TEST(ClockWatch, KnowsItsWarnings) {
    EXPECT_EQ(throttlingWarning(3, 3), "");
    EXPECT_EQ(throttlingWarning(3, 4), "clock fell: the processor was throttled 1 time (heat)");
    EXPECT_TRUE(saysClockFell(throttlingWarning(0, 2)));
    EXPECT_TRUE(saysClockFell(watched({{1800}, {900}}).warning()));
    EXPECT_FALSE(saysClockFell("the machine is busy"));
}

}  // namespace
}  // namespace dustbench::measure
