// Pictures of views and panels against golden ones, by FLIP. `make golden` draws them anew: look at them before they
// are kept.
//
// Nothing that is timed is in them. Between two rasterisers or two compilers a few pixels at edges differ by some steps
// of 8 bits, which FLIP weighs as less than 0.01 on average; two halves that are exchanged, a divider a tenth further
// or a line of text more are above 0.02.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "bench/measure/image/flip.h"
#include "bench/measure/image/heat_map.h"
#include "bench/view/panels/panel_target.h"
#include "bench/view/panels/panels_fixture.h"
#include "source_folder.h"

namespace dustbench::bench {
namespace {

constexpr double sameFlip = 0.01;

std::filesystem::path goldenFile(const std::string& name) {
    return std::filesystem::path(DUSTBENCH_SOURCE_DIR) / "bench/view/panels/golden" / (name + ".png");
}

bool isWritten() {
    const char* const wish = std::getenv("DUSTBENCH_GOLDEN");
    return wish && std::string_view(wish) == "write";
}

pictures::Image opaque(pictures::Image image) {
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

/// What differs stays in the folder for temporary files, as picture, reference and FLIP's map.
void expectGolden(const pictures::Image& displayed, const std::string& name) {
    const pictures::Image picture = opaque(pictures::decoded(displayed));
    if (isWritten()) {
        std::filesystem::create_directories(goldenFile(name).parent_path());
        return pictures::writeImage(picture, goldenFile(name));
    }
    const pictures::Image reference = pictures::readImage(goldenFile(name));
    ASSERT_EQ(picture.width, reference.width) << name;
    ASSERT_EQ(picture.height, reference.height) << name;
    const Measured difference = flip(preparePicture(reference, "golden"), preparePicture(picture, "drawn"));
    if (*difference.value <= sameFlip) return;
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "dustbench_golden";
    std::filesystem::create_directories(folder);
    pictures::writeImage(picture, folder / (name + ".png"));
    pictures::writeImage(reference, folder / (name + "_golden.png"));
    pictures::writeImage(heatMap(difference.map), folder / (name + "_flip.png"));
    ADD_FAILURE() << name << ": FLIP is " << *difference.value << ", allowed " << sameFlip << "; see " << folder
                  << ", and `make golden` if it is meant";
}

class GoldenPictures : public Panels {
 protected:
    void SetUp() override {
        if (!hasMethod("billboard") || !hasMethod("octree_search")) GTEST_SKIP() << "one of the methods is missing";
        open("billboard", "octree_search");
        ViewState state = viewer_->state();
        state.size = {192, 144};
        state.world = {{"particles", "600"}, {"preroll", "5"}};
        viewer_->apply(state);
        viewer_->advance(1e9);
        ASSERT_EQ(viewer_->message(), "");
        frames(2);
    }
    [[nodiscard]] pictures::Image viewed(Shown shown, Channel channel) {
        viewer_->split.shown = shown;
        viewer_->split.channel = channel;
        viewer_->advance();
        return draw::readBack(viewer_->image());
    }
};

TEST_F(GoldenPictures, OfViews) {
    expectGolden(viewed(Shown::wipe, Channel::picture), "wipe");
    expectGolden(viewed(Shown::difference, Channel::picture), "difference");
    expectGolden(viewed(Shown::wipe, Channel::outlines), "outlines");
    expectGolden(viewed(Shown::wipe, Channel::overdraw), "overdraw");
    viewer_->split.extent = glm::vec2(0.25f);
    viewer_->split.origin = glm::vec2(0.3f, 0.35f);
    expectGolden(viewed(Shown::beside, Channel::alpha), "alpha_beside_enlarged");
}

/// The panel without what is below the list of cameras: the costs of a viewer that has drawn one frame are empty.
TEST_F(GoldenPictures, OfThePanel) {
    if (!std::filesystem::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")) GTEST_SKIP() << "no DejaVu here";
    PanelTarget target(device_);
    ASSERT_TRUE(target.fit(520, 360));
    for (int n = 0; n < 3; ++n) panels_->draw(*viewer_, target.framebuffer(), 520, 360, {});
    expectGolden(draw::readBack(target.texture()), "panel");
}

}  // namespace
}  // namespace dustbench::bench
