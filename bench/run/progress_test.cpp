#include "bench/run/progress.h"

#include <gtest/gtest.h>

namespace dustbench::run {

TEST(Progress, LineSaysWhereWhatAndHowLong) {
    suite::PlannedRun run;
    run.spec.method = "billboard";
    run.spec.scene = "flat";
    run.spec.repetition = 2;
    run.label = "particles=1000";
    EXPECT_EQ(progressLine(3, 48, run, 5, 245), "[3/48] billboard flat particles=1000 rep 2/5 ETA 4 min 05 s");
    EXPECT_EQ(progressSentence(3, 48, run, 5, 245),
              "run 3 of 48: billboard in flat, particles=1000, repetition 2 of 5; about 4 min 05 s left");
    run.label = "";
    EXPECT_EQ(progressSentence(1, 1, run, 2, -1), "run 1 of 1: billboard in flat, repetition 2 of 2");
    EXPECT_EQ(progressLine(1, 1, run, 2, -1), "[1/1] billboard flat rep 2/2 ETA ?");
}

TEST(Progress, DurationsReadLikeAClock) {
    EXPECT_EQ(durationText(3.4), "3 s");
    EXPECT_EQ(durationText(59.6), "1 min 00 s");
    EXPECT_EQ(durationText(3'600 + 12 * 60), "1 h 12 min");
}

TEST(Progress, BarFillsWithTheFrames) {
    EXPECT_EQ(progressBar("frames 5 10", 24), "[#####.....] frames 5/10");
    EXPECT_EQ(progressBar("frames 10 10", 25), "[##########] frames 10/10");
    EXPECT_EQ(progressBar("hello", 80), "");
    EXPECT_EQ(progressBar("frames 5 20", 34, 3), "[##........] frames 5/20, 9 s left");
    EXPECT_EQ(progressBar("frames 5 20", 24, 0.1), "[##........] frames 5/20");
}

TEST(Progress, PhasesAreSentencesInLogs) {
    EXPECT_EQ(phaseSentence("frames 30 120", 10), "frames: 30 of 120, 30 s left");
    EXPECT_EQ(phaseSentence("preroll 0 60", 10), "preroll: 0 of 60");
    EXPECT_EQ(phaseSentence("frames 120 120", 10), "frames: 120 of 120");
    EXPECT_EQ(phaseSentence("hello", 10), "hello");
}

}  // namespace dustbench::run
