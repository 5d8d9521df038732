#include "bench/suite/tried_in_child.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace dustbench::bench {
namespace {

TEST(TriedInChild, WhatItReturnsArrives) {
    EXPECT_EQ(triedInChild([] { return std::string(); }), "");
    const std::string text(5000, 'x');
    EXPECT_EQ(triedInChild([&] { return text; }), text);
    int changed = 0;
    EXPECT_EQ(triedInChild([&] { return std::to_string(++changed); }), "1");
    EXPECT_EQ(changed, 0) << "the copy's memory is its own";
}

TEST(TriedInChild, HowItEndedIsSaid) {
    EXPECT_EQ(triedInChild([]() -> std::string { _exit(0); }), "a process that tried it ended with exit code 0");
    EXPECT_EQ(triedInChild([]() -> std::string {
                  std::fputs("first\nsecond\n", stderr);
                  _exit(7);
              }),
              "a process that tried it ended with exit code 7: second");
    EXPECT_EQ(triedInChild([]() -> std::string {
                  signal(SIGSEGV, SIG_DFL);
                  raise(SIGSEGV);
                  return "";
              }),
              "a process that tried it ended by signal 11 (Segmentation fault)");
}

TEST(TriedInChild, NothingIsPrintedHere) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    (void)triedInChild([] {
        std::cout << "out" << std::flush;
        std::cerr << "err";
        return std::string();
    });
    EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace dustbench::bench
