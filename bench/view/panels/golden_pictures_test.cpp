// Compares pictures of views and panels with golden ones, by FLIP. `make golden` draws them again: look at them before
// you commit them.
//
// They contain no times. Between two rasterisers or compilers, a few pixels at edges differ by some 8-bit steps, so the
// mean FLIP is below 0.01. Exchanged halves, a divider moved by a tenth or an additional line of text are above 0.02.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture_error.h"
#include "bench/view/panels/panel_canvas.h"
#include "bench/view/panels/panels_fixture.h"
#include "source_folder.h"

namespace dustbench::view {
namespace {

constexpr double sameFlip = 0.01;

std::filesystem::path goldenFile(const std::string& name) {
    return std::filesystem::path(DUSTBENCH_SOURCE_DIR) / "bench/view/panels/golden" / (name + ".png");
}

bool isWritten() {
    const char* const requested = std::getenv("DUSTBENCH_GOLDEN");
    return requested && std::string_view(requested) == "write";
}

pictures::Image opaque(pictures::Image image) {
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

/// If the picture differs, stores picture, reference and FLIP's map in the folder for temporary files.
void expectGolden(const pictures::Image& displayed, const std::string& name) {
    const pictures::Image picture = opaque(pictures::decoded(displayed));
    if (isWritten()) {
        std::filesystem::create_directories(goldenFile(name).parent_path());
        return pictures::writeImage(picture, goldenFile(name));
    }
    const pictures::Image reference = pictures::readImage(goldenFile(name));
    ASSERT_EQ(picture.width, reference.width) << name;
    ASSERT_EQ(picture.height, reference.height) << name;
    const measure::Measured difference =
        measure::flip(measure::preparePicture(reference, "golden"), measure::preparePicture(picture, "drawn"));
    if (*difference.value <= sameFlip) return;
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "dustbench_golden";
    std::filesystem::create_directories(folder);
    pictures::writeImage(picture, folder / (name + ".png"));
    pictures::writeImage(reference, folder / (name + "_golden.png"));
    pictures::writeImage(measure::heatMap(difference.map), folder / (name + "_flip.png"));
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
    expectGolden(viewed(Shown::sideBySide, Channel::alpha), "alpha_beside_enlarged");
}

/// The upper part of the panel, down to the list of cameras. The costs below are empty after one frame.
TEST_F(GoldenPictures, OfThePanel) {
    if (!std::filesystem::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")) GTEST_SKIP() << "no DejaVu here";
    PanelTarget target(device_);
    ASSERT_TRUE(target.fit(520, 360));
    for (int n = 0; n < 3; ++n) panels_->draw(*viewer_, target.framebuffer(), 520, 360, {});
    expectGolden(draw::readBack(target.texture()), "panel");
}

}  // namespace
}  // namespace dustbench::view
