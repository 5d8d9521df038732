#include "methods/contract/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/contract/errors.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench {
namespace {

enum class Order { none, radix, quicksort };
constexpr Choices<Order> orders{{"quicksort", Order::quicksort}, {"radix", Order::radix}, {"none", Order::none}};

ParameterSet sample() {
    ParameterSet set;
    set.integer("depth", 7, 4, 12, "levels", "depth of the tree")
        .real("share", 0.5, 0, 1, "", "a share")
        .boolean("soft", false, "soft edges")
        .choice("sort", Order::radix, orders, "order of drawing")
        .cells("grid", "128x64x64", 4, 512, "cells along x, y and z");
    return set;
}

std::string errorOf(ParameterValues& values, std::string_view name, std::string_view text) {
    try {
        values.set(name, text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

ParameterSet withPreset() {
    ParameterSet set = sample();
    set.choice("mode", "fixed", {"fixed", "paper"}, "which")
        .preset("mode", "paper", {{"sort", "quicksort"}, {"depth", "09"}});
    return set;
}

TEST(Parameters, TakeTheDefaultsOfAPresetUnlessTheyAreSet) {
    ParameterValues values(withPreset());
    EXPECT_EQ(values.choice("sort"), "radix");
    values.set("mode", "paper");
    EXPECT_EQ(values.choice("sort"), "quicksort");
    EXPECT_EQ(values.canonical().at("depth"), "9");
    EXPECT_EQ(values.real("share"), 0.5);
    values.set("sort", "none");
    EXPECT_EQ(values.choice("sort"), "none");
    values.set("mode", "fixed");
    EXPECT_EQ(values.integer("depth"), 7);
    EXPECT_EQ(values.choice("sort"), "none");
    EXPECT_EQ(withPreset().find("mode")->help, "which; paper sets other defaults (sort=quicksort, depth=9)");
}

TEST(Parameters, TakeAPresetWhateverTheOrder) {
    ParameterValues first(withPreset()), last(withPreset());
    first.set("mode", "paper");
    first.set("depth", "7");  // the default of the other mode, but set explicitly
    last.set("depth", "7");
    last.set("mode", "paper");
    EXPECT_EQ(first.canonical(), last.canonical());
    EXPECT_EQ(first.integer("depth"), 7);
    EXPECT_EQ(first.choice("sort"), "quicksort");
    // The canonical form, read again, is unchanged.
    ParameterValues again(withPreset());
    for (const auto& [name, text] : first.canonical()) again.set(name, text);
    EXPECT_EQ(again.canonical(), first.canonical());
}

TEST(Parameters, RefuseAPresetOfWhatIsNotDeclared) {
    EXPECT_THROW(withPreset().preset("mode", "printed", {}), std::logic_error);
    EXPECT_THROW(withPreset().preset("mood", "paper", {}), std::logic_error);
    EXPECT_THROW(withPreset().preset("mode", "paper", {{"sort", "bubble"}}), std::logic_error);
    EXPECT_THROW(withPreset().preset("mode", "paper", {{"order", "radix"}}), std::logic_error);
    EXPECT_THROW(withPreset().preset("mode", "paper", {{"mode", "fixed"}}), std::logic_error);
}

TEST(Parameters, StartAtTheirDefaults) {
    const ParameterValues values(sample());
    EXPECT_EQ(values.integer("depth"), 7);
    EXPECT_EQ(values.real("share"), 0.5);
    EXPECT_FALSE(values.boolean("soft"));
    EXPECT_EQ(values.choice("sort", orders), Order::radix);
}

TEST(Parameters, ReadAChoiceByItsWordWhateverTheOrderOfTheEnumerators) {
    ParameterValues values(sample());
    EXPECT_EQ(values.declared().find("sort")->choices, (std::vector<std::string>{"quicksort", "radix", "none"}));
    for (const auto& [word, order] : orders.all()) {
        values.set("sort", word);
        EXPECT_EQ(values.choice("sort"), word);
        EXPECT_EQ(values.choice("sort", orders), order);
    }
}

TEST(Parameters, RefuseToReadAChoiceByAnotherTable) {
    static constexpr Choices<Order> others{{"radix", Order::radix}, {"none", Order::none}};
    EXPECT_THROW((void)ParameterValues(sample()).choice("sort", others), std::logic_error);
    EXPECT_THROW((void)ParameterValues(sample()).choice("depth", orders), std::logic_error);
}

TEST(Parameters, HaveOneCanonicalTextForEqualValues) {
    ParameterValues a(sample()), b(sample());
    a.set("share", "0.250");
    b.set("share", "+.25");
    a.set("grid", "032x8x+16");
    b.set("grid", "32x8x16");
    EXPECT_EQ(a.cells("grid"), (std::array{32, 8, 16}));
    a.set("soft", "true");
    b.set("soft", "on");
    EXPECT_EQ(a.canonical(), b.canonical());
}

TEST(Parameters, SayWhatWasGotAndWhatIsAllowed) {
    ParameterValues values(sample());
    EXPECT_EQ(errorOf(values, "depth", "13"), "parameter depth: got '13', allowed: integer 4..12 levels");
    EXPECT_EQ(errorOf(values, "depth", "7.5"), "parameter depth: got '7.5', allowed: integer 4..12 levels");
    EXPECT_EQ(errorOf(values, "share", "nan"), "parameter share: got 'nan', allowed: number 0..1");
    EXPECT_EQ(errorOf(values, "sort", "bubble"), "parameter sort: got 'bubble', allowed: quicksort|radix|none");
    for (const char* text : {"128x64", "128x64x64x64", "3x64x64", "ax64x64", "", "xx", "128X64X64", "128x64x64x"})
        EXPECT_EQ(errorOf(values, "grid", text), "parameter grid: got '" + std::string(text) +
                                                     "', allowed: a grid such as 128x64x64, 4..512 cells along each "
                                                     "edge");
    EXPECT_EQ(errorOf(values, "dept", "5"),
              "unknown parameter 'dept' (did you mean 'depth'?); known: depth, share, soft, sort, grid");
}

TEST(Parameters, KeepTheirValueWhenABadOneIsRefused) {
    ParameterValues values(sample());
    (void)errorOf(values, "depth", "99");
    EXPECT_EQ(values.integer("depth"), 7);
}

TEST(Parameters, RefuseToBeDeclaredTwiceOrWithABadDefault) {
    ParameterSet set = sample();
    EXPECT_THROW(set.real("depth", 1, 0, 2, "", ""), std::logic_error);
    EXPECT_THROW(set.real("new", 3, 0, 2, "", ""), std::logic_error);
}

TEST(Parameters, ChangesAreSortedByTimeAndKeepTheirTexts) {
    ParameterSet set;
    set.changes("at", "changes");
    ParameterValues values(set);
    EXPECT_TRUE(values.changes("at").empty());
    values.set("at", "2.50s:velocity.speed=8;+1s:velocity.part=a=b;2.5s:x=2");
    EXPECT_EQ(values.canonical().at("at"), "1s:velocity.part=a=b;2.5s:velocity.speed=8;2.5s:x=2");
    EXPECT_EQ(values.changes("at"),
              (std::vector<Change>{{1, "velocity.part", "a=b"}, {2.5, "velocity.speed", "8"}, {2.5, "x", "2"}}));
    for (const char* bad : {"2.5:a=1", "-1s:a=1", "infs:a=1", "s:a=1", "1s:a", "1s:a=", "1s:=1", "a=1s:2", "1s:a=1;;"})
        EXPECT_NE(inputError([&] { values.set("at", bad); }).find("allowed: SECONDSs:NAME=VALUE"), std::string::npos)
            << bad;
}

}  // namespace
}  // namespace dustbench
