#include <gtest/gtest.h>

#include "methods/contract/errors.h"
#include "methods/kit/octree/octree_dust.h"

namespace dustbench::octree {
namespace {

TEST(OctreeSettings, RefusesMoreLevelsThanThereAre) {
    MethodInfo info;
    declareDust(info);
    ParameterValues values(info.parameters);
    values.set("depth", "5");
    values.set("levels", "6");
    EXPECT_THROW((void)dustSettings(values), InputError);
    values.set("levels", "5");
    EXPECT_EQ(dustSettings(values).tree.levels, 5);
}

TEST(OctreeDust, HasAPresetOfThePaper) {
    MethodInfo info;
    declareDust(info);
    declareLayout(info, "how");
    ParameterValues values(info.parameters);
    EXPECT_EQ(values.choice("layout"), "faithful");
    EXPECT_EQ(dustSettings(values).opacity, draw::OpacityFrom::dust);
    values.set("mode", "paper");
    EXPECT_EQ(values.choice("layout"), "paper");
    const DustSettings settings = dustSettings(values);
    EXPECT_EQ(settings.opacity, draw::OpacityFrom::age);
    EXPECT_EQ(settings.render, Render::circles);
    EXPECT_EQ(settings.sort, draw::SortKind::quicksort);
}

}  // namespace
}  // namespace dustbench::octree
