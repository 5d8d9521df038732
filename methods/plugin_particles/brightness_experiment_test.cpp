#include "methods/plugin_particles/brightness_experiment.h"

#include <gtest/gtest.h>

#include <map>

#include "methods/kit/draw/test_canvas.h"

namespace dustbench::plugin_particles::brightness {
namespace {

TEST(Brightness, FollowsFromTheWayOfDrawing) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        std::map<std::string, Finding> found;
        for (const Finding& each : measureBrightness(draw::TestCanvas::device(), seed)) found[each.quantity] = each;
        EXPECT_EQ(found.size(), 8u);
        EXPECT_EQ(found["point_light_4x"].value, 1);
        // α·L/2 of a line of L pixels along the longer axis: 4, except for the pixel at its end.
        EXPECT_NEAR(found["line_light_4x"].value, 4, 0.3);
        // 10/2 + 1 pixels against 40/2 + 1, averaged over directions.
        EXPECT_GT(found["hybrid_light_4x"].value, 2.5);
        EXPECT_LT(found["hybrid_light_4x"].value, found["line_light_4x"].value);
        EXPECT_LT(found["shuffled_additive"].value, 1e-5);
        EXPECT_LT(found["shuffled_clamped"].value, 1e-5);
        EXPECT_GT(found["shuffled_alpha"].value, 0.1);
        EXPECT_EQ(found["contrast_white_additive"].value, 0);
        EXPECT_GT(found["contrast_white_alpha"].value, 0.3);
    }
}

}  // namespace
}  // namespace dustbench::plugin_particles::brightness
