#include "bench/suite/method_libraries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "methods/contract/registry.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/library/build_fingerprint.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::suite {
namespace {

using testing::HasSubstr;

TEST(MethodLibraries, FingerprintsSayWhatDiffers) {
    EXPECT_EQ(fingerprintDifference("A=1;B=B;C=;", "A=1;B=B;C=;"), "");
    EXPECT_EQ(fingerprintDifference("A=1;", "A=A;"), "A is 1, expected undefined");
    EXPECT_EQ(fingerprintDifference("A=A;", "A=;"), "A is undefined, expected defined");
    EXPECT_EQ(fingerprintDifference("A=1;", "A=1;B=2;"), "B is unknown, expected 2");
    EXPECT_EQ(fingerprintDifference("A=1;B=2;", "A=2;"), "A is 1, expected 2; B is 2, expected unknown");
    EXPECT_EQ(fingerprintDifference("", ""), "");
}

TEST(MethodLibraries, TheFingerprintTellsCompilerAndFloatingPoint) {
    const std::string text = library::buildFingerprint();
    EXPECT_THAT(text, HasSubstr("__cplusplus=2020"));
    EXPECT_THAT(text, HasSubstr("__VERSION__=\"" __VERSION__ "\";"));
    EXPECT_THAT(text, HasSubstr("fp-contract=0;")) << "all of dustbench is built without contraction";
    EXPECT_THAT(text, HasSubstr("__FAST_MATH__=__FAST_MATH__;"));
}

TEST(MethodLibraries, AnIdIsGivenOnce) {
    MethodInfo info;
    info.id = "outside_for_this_test";
    info.library = "/somewhere/outside.dustmethod.so";
    const std::size_t before = methods().size();
    addMethod(info);
    EXPECT_EQ(methods().size(), before + 1);
    EXPECT_TRUE(std::ranges::is_sorted(methods(), {}, &MethodInfo::id));
    EXPECT_EQ(findMethod("outside_for_this_test").library, info.library);
    EXPECT_THAT(inputError([&] { addMethod(info); }), HasSubstr("already exists, from /somewhere"));
    info.id = "null_method";
    EXPECT_THAT(inputError([&] { addMethod(info); }), HasSubstr("already exists, in this build"));
}

TEST(MethodLibraries, ALibraryIsAnInputOfWhatUsesIt) {
    const std::filesystem::path ofMethod = "/somewhere/noted.dustmethod.so", ofPart = "/somewhere/part.dustmethod.so";
    MethodInfo info;
    info.id = "noted_for_this_test";
    info.library = ofMethod;
    addMethod(std::move(info));
    particles::PartInfo part;
    part.kind = particles::PartKind::force;
    part.name = "noted";
    part.library = ofPart;
    particles::addPart(part);
    const files::InputLog log;
    (void)findMethod("null_method");
    EXPECT_THAT(log.files(), testing::IsEmpty());
    (void)findMethod("noted_for_this_test");
    EXPECT_THAT(log.files(), testing::ElementsAre(ofMethod));
    (void)particles::findPart(particles::PartKind::force, "noted");
    EXPECT_THAT(log.files(), testing::ElementsAre(ofMethod, ofPart));
}

TEST(MethodLibraries, APartIsGivenOnceAndKnowsItsName) {
    particles::PartInfo part = particles::findPart(particles::PartKind::size, "linear");
    EXPECT_THAT(inputError([&] { particles::addPart(part); }),
                HasSubstr("size part 'linear' already exists, in this build"));
    part.name = "new_for_this_test";
    part.library = "/somewhere/part.dustmethod.so";
    particles::addPart(part);
    EXPECT_EQ(particles::makePart(particles::PartKind::size, "new_for_this_test")->name(), "new_for_this_test");
    EXPECT_THAT(inputError([&] { particles::addPart(part); }), HasSubstr("already exists, from /somewhere"));
}

TEST(MethodLibraries, ARefusedOneIsNamedWhenItIsAskedFor) {
    noteRefusedMethod("refused_for_this_test", "x.so", "it is old");
    EXPECT_EQ(inputError([] { (void)findMethod("refused_for_this_test"); }),
              "method 'refused_for_this_test': 'x.so' was not loaded: it is old");
}

TEST(MethodLibraries, FoldersMustExist) {
    EXPECT_THAT(inputError([] { useMethodFolders("--method-path", {"/nowhere/at/all"}); }),
                HasSubstr("--method-path: '/nowhere/at/all': no such folder"));
}

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
}  // namespace dustbench::suite
