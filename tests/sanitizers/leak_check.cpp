// Part of every test program under AddressSanitizer: searches for leaks after the last test.
//
// By default LeakSanitizer searches when the process exits. oneTBB and Mesa end their threads at that time, and
// LeakSanitizer has crashed there after all tests had passed ("Tracer caught signal 11").
#include <gtest/gtest.h>
#include <sanitizer/lsan_interface.h>

namespace {

class LeakCheck final : public testing::Environment {
    void TearDown() override { __lsan_do_leak_check(); }  // ends the process if there are leaks
};

const testing::Environment* const leakCheck = testing::AddGlobalTestEnvironment(new LeakCheck);

}  // namespace
