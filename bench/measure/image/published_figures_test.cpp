// PSNR, SSIM and FLIP against other programs' results for the same pictures (test_images.h).
//
// How the figures were obtained. Each pair was computed by its formula with numpy, in double precision, rounded to
// 32-bit floats and clamped to [0, 1].
// - psnr_db, ssim: scikit-image 0.19.3 (Debian's python3-skimage) on the values encoded by the sRGB curve:
//   peak_signal_noise_ratio(a, b, data_range=1) of the three channels, and of 0.2126 R + 0.7152 G + 0.0722 B
//   structural_similarity(a, b, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1), which
//   leaves out windows that are not wholly inside.
// - rmse_linear: numpy, sqrt(mean((a − b)²)).
// - flip: the authors' own C++ (github.com/NVlabs/flip, src/cpp/FLIP.h, commit 1eb247c) compiled without CUDA:
//   FLIP::evaluate(…) for low dynamic range on the linear values, at its default of 67.0206 pixels per degree and at
//   25, mean of the map, and the map at two pixels.
#include <gtest/gtest.h>

#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/test_images.h"

namespace dustbench::measure {
namespace {

struct Published {
    const char* name;
    TestPair pair;
    double psnrDb, ssim, rmseLinear;
    double flip, flipAt60x45, flipAt7x80;        // 67.0206 pixels per degree
    double flip25, flip25At60x45, flip25At7x80;  // 25
};

std::vector<Published> published() {
    return {{"waves", waves(), 18.3592348, 0.6856401, 0.1409226, 0.2658632, 0.241470, 0.205100, 0.2853407, 0.249884,
             0.192712},
            {"checkers", checkers(), 14.7547250, 0.6547619, 0.2316157, 0.2304033, 0.060867, 0.239753, 0.2232477,
             0.015119, 0.812017},
            {"green and blue", greenAndBlue(), 4.7712125, 0.5560452, 0.5773503, 0.5420380, 0.993795, 0, 0.5156682,
             0.998579, 0},
            {"puffs", puffs(), 48.9956019, 0.9992254, 0.0043036, 0.0122080, 0.028093, 0.000080, 0.0114024, 0.026987,
             0.000016}};
}

class PublishedFigures : public testing::TestWithParam<Published> {
 protected:
    Picture reference_ = pictureOf(pairWidth, pairHeight, GetParam().pair.reference);
    Picture image_ = pictureOf(pairWidth, pairHeight, GetParam().pair.image);
};

TEST_P(PublishedFigures, OfScikitImageAreMet) {
    const PictureError error = pictureError(reference_, image_);
    ASSERT_TRUE(error.psnrDb);
    EXPECT_NEAR(*error.psnrDb, GetParam().psnrDb, 1e-4);
    EXPECT_NEAR(error.rmseLinear, GetParam().rmseLinear, 1e-6);
    EXPECT_FALSE(error.identical);
    EXPECT_NEAR(ssim(reference_, image_).value.value(), GetParam().ssim, 1e-5);
}

TEST_P(PublishedFigures, OfFlipsAuthorsAreMet) {
    const Measured near = flip(reference_, image_), far = flip(reference_, image_, 25);
    EXPECT_NEAR(near.value.value(), GetParam().flip, 1e-5);
    EXPECT_NEAR(far.value.value(), GetParam().flip25, 1e-5);
    EXPECT_NEAR(near.map.at(60, 45), GetParam().flipAt60x45, 1e-4);
    EXPECT_NEAR(near.map.at(7, 80), GetParam().flipAt7x80, 1e-4);
    EXPECT_NEAR(far.map.at(60, 45), GetParam().flip25At60x45, 1e-4);
    EXPECT_NEAR(far.map.at(7, 80), GetParam().flip25At7x80, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Pairs, PublishedFigures, testing::ValuesIn(published()), [](const auto& chosen) {
    std::string name = chosen.param.name;
    std::erase(name, ' ');
    return name;
});

}  // namespace
}  // namespace dustbench::measure
