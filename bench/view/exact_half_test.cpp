// The ground truth as half B, and its metrics, compared with those of a run with metrics.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/run/measured_run.h"
#include "bench/view/view_session.h"
#include "bench/view/viewer.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

bool isBuilt(std::string_view id) {
    return std::ranges::any_of(methods(), [id](const MethodInfo& info) { return info.id == id; });
}

ViewState small(const std::string& method) {
    ViewState state;
    state.size = {64, 48};
    state.world = {{"particles", "300"}, {"preroll", "0.3"}};
    state.a.method = method;
    state.b = HalfState{exactPicture, {}};
    return state;
}

TEST(ExactHalf, GivesTheNumbersAndThePictureOfAJudgedRun) {
    if (!isBuilt("billboard")) GTEST_SKIP() << "no billboards here";
    const TestFolder folder;
    ViewState state = small("billboard");
    state.drive = "slalom";
    state.seed = 3;
    state.frame = 4;
    measure::MetricValues shown;
    pictures::Image reference;
    {
        gpu::Device device;
        ViewSession session(state, device);
        while (session.stepsToGo() > 0) session.step();
        session.drawExact();
        ASSERT_EQ(session.exact().whyNotEvaluated(), "");
        shown = session.exact().evaluated().metrics.values;
        reference = session.image(Half::b);
    }
    results::RunSpec spec = runOf(state, Half::a);
    spec.imagesEvery = 0;
    spec.metricPlan.emplace().moments = exports::FrameRange{0, 4, 1};
    (void)run::measureRun(spec, folder.path(), {}, [](std::string_view, std::int64_t, std::int64_t) {});
    const auto table = files::CsvTable::parseFile(folder.path() / "metrics.csv");
    const auto row = table.rows() - 1;
    ASSERT_EQ(table.cell(row, "frame"), "4");
    for (const char* column : {"psnr_db", "ssim", "flip", "rmse_linear", "psnr_mask_db", "ssim_mask", "flip_mask",
                               "rmse_linear_mask", "error_max"}) {
        const std::optional<double> value = shown.of(column);
        ASSERT_TRUE(value) << column;
        EXPECT_NEAR(*value, std::stod(std::string(table.cell(row, column))), 1e-6 * std::abs(*value)) << column;
    }
    EXPECT_GT(*shown.of("flip_mask"), 1e-3);  // hard billboards differ from the ground truth
    const pictures::Image saved = pictures::readImage(folder.path() / "images" / "f000004_reference.exr");
    ASSERT_EQ(saved.pixels.size(), reference.pixels.size());
    for (std::size_t i = 0; i < saved.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(saved.pixels[i][channel], reference.pixels[i][channel], 1e-6f);
}

class ExactInViewer : public testing::Test {
 protected:
    gpu::Device device_;
    TestFolder folder_;
};

TEST_F(ExactInViewer, IsDrawnAtRestAndNeverOfAnotherMomentThanA) {
    Viewer viewer(small(methods().front().id), device_, folder_.path());
    viewer.advance(1e9);
    for (int n = 0; n < 3; ++n) viewer.advance();
    EXPECT_FALSE(viewer.session().isEvaluated());
    EXPECT_EQ(viewer.session().isCurrent(Half::b), isBuilt(groundTruthMethod));
    EXPECT_EQ(viewer.settingsNow().shown, isBuilt(groundTruthMethod) ? Shown::wipe : Shown::a);
    EXPECT_THAT(viewer.stamp(), HasSubstr("frame 3: A " + methods().front().id));
    EXPECT_EQ(viewer.stamp().find("| B exact") != std::string::npos, isBuilt(groundTruthMethod));
    viewer.press(Key::space, false);
    viewer.advance();
    viewer.advance();
    ASSERT_TRUE(viewer.session().isEvaluated());
    EXPECT_EQ(viewer.settingsNow().shown, Shown::wipe);
    EXPECT_THAT(viewer.stamp(), HasSubstr("| B exact"));
    EXPECT_GT(viewer.session().exact().seconds(), 0);
    viewer.turnCamera(0.1, 0);
    viewer.advance();  // the camera has just moved
    EXPECT_FALSE(viewer.session().isEvaluated());
    viewer.advance();
    EXPECT_TRUE(viewer.session().isEvaluated());
    viewer.press(Key::period, false);
    viewer.advance();
    EXPECT_FALSE(viewer.session().isEvaluated());
}

/// While the world moves, a method draws the ground truth in half B.
TEST_F(ExactInViewer, IsDrawnLiveByTheTruthAsAMethodAndIsTheJudgesPictureTo1e5) {
    if (!isBuilt(groundTruthMethod) || !isBuilt("billboard")) GTEST_SKIP() << "no truth as a method, or no billboards";
    ViewState state = small("billboard");
    state.world["camera"] = "fixed";  // a camera that moves would be listed for anyway
    state.frame = 3;
    gpu::Device device;
    ViewSession session(state, device);
    double most = 0;
    for (int n = 0; n < 3; ++n) {
        do session.step();
        while (session.stepsToGo() > 0);
        session.draw();
        ASSERT_TRUE(session.isCurrent(Half::b));
        ASSERT_FALSE(session.isEvaluated());
        const pictures::Image live = session.image(Half::b), a = session.image(Half::a);
        session.drawExact();
        ASSERT_TRUE(session.isEvaluated());
        const pictures::Image exact = session.image(Half::b);
        for (std::size_t i = 0; i < exact.pixels.size(); ++i)
            for (int channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(live.pixels[i][channel], exact.pixels[i][channel], 1e-5f);
                most = std::max(most, std::abs(static_cast<double>(a.pixels[i][channel] - exact.pixels[i][channel])));
            }
    }
    EXPECT_GT(most, 1e-4);  // there is dust, and billboards differ from the ground truth
    session.step();
    session.draw({32, 24});
    EXPECT_EQ(session.picture(Half::b).width(), 32);
}

TEST_F(ExactInViewer, IsDrawnOnDemandAndEveryFrameIfAskedFor) {
    Viewer viewer(small(methods().front().id), device_, folder_.path());
    viewer.advance(1e9);
    viewer.advance();
    viewer.press(Key::e, false);
    EXPECT_TRUE(viewer.paused);
    viewer.advance();
    EXPECT_TRUE(viewer.session().isEvaluated());
    viewer.paused = false;
    viewer.exactEveryFrame = true;
    for (int n = 0; n < 3; ++n) {
        viewer.advance();
        ASSERT_TRUE(viewer.session().isEvaluated());
        EXPECT_THAT(viewer.stamp(), HasSubstr(fmt::format("frame {}:", viewer.session().frame())));
    }
    ViewState state = viewer.state();
    state.b.reset();
    viewer.apply(state);
    viewer.press(Key::e, false);
    EXPECT_THAT(viewer.message(), HasSubstr("as B"));
}

TEST_F(ExactInViewer, IsShownAsItsPictureIs) {
    Viewer viewer(small(methods().front().id), device_, folder_.path());
    viewer.advance(1e9);
    viewer.paused = true;
    viewer.advance();
    viewer.advance();
    viewer.split.shown = Shown::b;
    viewer.advance();
    const pictures::Image exact = viewer.session().image(Half::b), shown = draw::readBack(viewer.image());
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(shown.pixels[i][channel], pictures::encodeSrgb(exact.pixels[i][channel]), 0.51f / 255);
    // The same light, composed on the GPU.
    viewer.split.stops = 1e-6f;
    viewer.advance();
    const pictures::Image again = draw::readBack(viewer.image());
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(shown.pixels[i][channel], again.pixels[i][channel], 1.01f / 255);
}

TEST_F(ExactInViewer, GivesNoNumbersToAMethodWithASimulationOfItsOwn) {
    if (!isBuilt("plugin_particles")) GTEST_SKIP() << "no method with a simulation of its own here";
    Viewer viewer(small("plugin_particles"), device_, folder_.path());
    viewer.advance(1e9);
    viewer.press(Key::e, false);
    viewer.advance();
    ASSERT_TRUE(viewer.session().isCurrent(Half::b));
    EXPECT_THAT(viewer.session().exact().whyNotEvaluated(), HasSubstr("runs its own simulation"));
    EXPECT_FALSE(viewer.session().exact().evaluated().metrics.values.of("psnr_db"));
    viewer.split.shown = Shown::flip;  // the pictures can still be compared
    viewer.advance();
    EXPECT_TRUE(viewer.maps().flipMean());
}

}  // namespace
}  // namespace dustbench::view
