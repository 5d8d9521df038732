#include "methods/billboard/billboard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::billboard {
namespace {

/// Dust in front of an eye, over an empty scene.
class Moment : public TestMoment {
 public:
    explicit Moment(std::size_t count, std::uint32_t seed = 1) : TestMoment(count, 160, 120, {0, 2, 0}, {0, 0, -10}) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            dust.serial[i] = 1000 + i;
            dust.x[i] = 8 * uniform(random) - 4;
            dust.y[i] = 4 * uniform(random);
            dust.z[i] = -6 - 20 * uniform(random);
            dust.radius[i] = 0.2f + uniform(random);
            dust.opacity[i] = 0.3f * uniform(random);
            dust.lifetime[i] = 5;
            dust.age[i] = 5 * uniform(random);
        }
        dust.colourOfAll = {0.6f, 0.4f, 0.2f};
    }
};

std::unique_ptr<Method> prepared(const Moment& moment, const std::vector<std::pair<std::string, std::string>>& values) {
    const MethodInfo info = describe();
    ParameterValues parameters(info.parameters);
    for (const auto& [name, value] : values) parameters.set(name, value);
    auto method = info.create(parameters);
    method->prepare(moment.scene, {}, Moment::device());
    return method;
}

double largestDifference(const pictures::Image& a, const pictures::Image& b, bool alphaOnly) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = alphaOnly ? 3 : 0; c < 4; ++c)
            largest = std::max(largest, std::abs(static_cast<double>(a.pixels[i][c] - b.pixels[i][c])));
    return largest;
}

TEST(Billboard, ShowsTheTransmittanceOfTheWholeCloud) {
    Moment moment(300);
    const auto method = prepared(moment, {});
    const pictures::Image image = moment.updateAndDraw(*method);
    double squares = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::dvec3 ray = moment.view.rayDirection(x + 0.5, y + 0.5);
            double depth = 0;
            for (std::size_t i = 0; i < moment.dust.size(); ++i) {
                const glm::dvec3 centre = glm::dvec3(moment.dust.position(i)) - moment.view.camera.eye;
                const double foot = glm::dot(centre, ray), b = glm::length(centre - foot * ray);
                depth -= std::log1p(-maths::billboardOpacity(static_cast<double>(moment.dust.opacity[i]),
                                                             static_cast<double>(moment.dust.radius[i]), b));
            }
            const double difference = static_cast<double>(image.at(x, y).a) + std::expm1(-depth);
            EXPECT_NEAR(difference, 0, 0.02);  // each quad cuts off up to τ·exp(−9/2) at its corners
            squares += difference * difference;
        }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(image.pixels.size())), 2e-3);
}

TEST(Billboard, SortsAloneDoNotChangeThePictureOfOneColour) {
    const std::size_t count = 2'000;
    Moment moment(count);
    const pictures::Image radix = moment.updateAndDraw(*prepared(moment, {{"sort", "radix"}}));
    const pictures::Image quick = moment.updateAndDraw(*prepared(moment, {{"sort", "quicksort"}}));
    const pictures::Image none = moment.updateAndDraw(*prepared(moment, {{"sort", "none"}}));
    EXPECT_EQ(quick.pixels, radix.pixels);
    EXPECT_LT(largestDifference(radix, none, false), 1e-5);
}

TEST(Billboard, SortMattersWhereColoursDiffer) {
    Moment moment(500);
    moment.dust.keepOneColour(false);
    for (std::size_t i = 0; i < moment.dust.size(); ++i) {
        // Nearer puffs are red, farther ones green, so that the order shows.
        moment.dust.red[i] = moment.dust.z[i] > -12 ? 1.0f : 0.0f;
        moment.dust.green[i] = 1 - moment.dust.red[i];
        moment.dust.blue[i] = 0;
    }
    const pictures::Image radix = moment.updateAndDraw(*prepared(moment, {{"sort", "radix"}}));
    const pictures::Image quick = moment.updateAndDraw(*prepared(moment, {{"sort", "quicksort"}}));
    const pictures::Image none = moment.updateAndDraw(*prepared(moment, {{"sort", "none"}}));
    EXPECT_EQ(quick.pixels, radix.pixels);
    EXPECT_LT(largestDifference(radix, none, true), 1e-5);
    EXPECT_GT(largestDifference(radix, none, false), 0.05);
}

TEST(Billboard, DrawsTheSameAgainInEveryMode) {
    Moment moment(200);
    std::vector<pictures::Image> pictures;
    for (const char* puff : {"gaussian", "texture", "textures", "animated"})
        for (const char* soft : {"false", "true"})
            for (const char* facing : {"viewpoint", "viewplane"}) {
                const auto method = prepared(moment, {{"puff", puff}, {"soft", soft}, {"facing", facing}});
                const pictures::Image image = moment.updateAndDraw(*method);
                EXPECT_EQ(moment.draw(*method).pixels, image.pixels) << puff << soft << facing;
                EXPECT_EQ(moment.updateAndDraw(*method).pixels, image.pixels) << puff << soft << facing;
                EXPECT_EQ(method->primitives(), 200);
                double alpha = 0;
                for (const glm::vec4& pixel : image.pixels) {
                    ASSERT_TRUE(pixel.a >= 0 && pixel.a <= 1);
                    alpha += static_cast<double>(pixel.a);
                }
                EXPECT_GT(alpha, 1000) << puff << soft << facing;
                pictures.push_back(image);
            }
    for (std::size_t i = 0; i < pictures.size(); i += 4)
        for (std::size_t j = 0; j < i; j += 4) EXPECT_GT(largestDifference(pictures[i], pictures[j], true), 0.01);
}

TEST(Billboard, DrawsTheSamePictureInTiles) {
    Moment moment(300);
    moment.dust.keepOneColour(false);
    for (std::size_t i = 0; i < moment.dust.size(); ++i) {
        moment.dust.red[i] = moment.dust.opacity[i];
        moment.dust.green[i] = moment.dust.age[i] / 5;
        moment.dust.blue[i] = 1;
    }
    moment.setWall(15, 100);
    using Values = std::vector<std::pair<std::string, std::string>>;
    const float tolerance = Moment::device().isSoftware() ? 1e-5f : 1e-2f;  // GPUs round places within a quad
    for (Values values :
         {Values{}, Values{{"sort", "none"}, {"soft", "true"}}, Values{{"sort", "quicksort"}, {"facing", "viewplane"}},
          Values{{"alpha", "plain"}, {"opacity", "age"}}}) {
        const pictures::Image hardware = moment.updateAndDraw(*prepared(moment, values));
        values.emplace_back("raster", "tiles");
        const auto method = prepared(moment, values);
        const pictures::Image tiles = moment.updateAndDraw(*method);
        std::size_t different = 0;  // at the edges of quads, see the tests of TileBillboards
        for (std::size_t i = 0; i < tiles.pixels.size(); ++i)
            for (int c = 0; c < 4; ++c)
                different += std::abs(tiles.pixels[i][c] - hardware.pixels[i][c]) > tolerance ? 1 : 0;
        EXPECT_LE(different, 40u);
        EXPECT_LT(largestDifference(tiles, hardware, false), 0.02);
        EXPECT_EQ(method->primitives(), 300);
    }
    EXPECT_THROW(prepared(moment, {{"raster", "tiles"}, {"puff", "texture"}}), InputError);
    EXPECT_THROW(prepared(moment, {{"raster", "tiles"}, {"mode", "paper"}}), InputError);
}

TEST(Billboard, DrawsThePapersOpacityFromAgeAlone) {
    Moment moment(300);
    const auto paper = prepared(moment, {{"mode", "paper"}});
    const pictures::Image image = moment.updateAndDraw(*paper);
    EXPECT_EQ(moment
                  .updateAndDraw(*prepared(
                      moment, {{"sort", "quicksort"}, {"puff", "texture"}, {"alpha", "plain"}, {"opacity", "age"}}))
                  .pixels,
              image.pixels);
    EXPECT_GT(largestDifference(moment.updateAndDraw(*prepared(moment, {})), image, true), 0.05);
    // The dust's own opacity has no effect; age does.
    for (float& opacity : moment.dust.opacity) opacity = 0.9f;
    EXPECT_EQ(moment.updateAndDraw(*paper).pixels, image.pixels);
    for (float& age : moment.dust.age) age *= 0.5f;
    EXPECT_GT(largestDifference(moment.updateAndDraw(*paper), image, true), 0.05);
    for (float& age : moment.dust.age) age = 5;
    for (const glm::vec4& pixel : moment.updateAndDraw(*paper).pixels) ASSERT_EQ(pixel, glm::vec4(0));
}

TEST(Billboard, TellsTheOpacityThatItDraws) {
    class Collector final : public VolumeVisitor {
     public:
        void puffs(const Puffs& puffs) override { opacity.assign(puffs.opacity.begin(), puffs.opacity.end()); }
        void grid(const GridVolume&) override { ADD_FAILURE() << "grid"; }
        void octree(const OctreeVolume&) override { ADD_FAILURE() << "octree"; }
        std::vector<float> opacity;
    } collector;
    Moment moment(100);
    const auto method = prepared(moment, {{"mode", "paper"}, {"young_opacity", "0.8"}});
    method->update(moment.frame());
    method->volume(moment.frame(), collector);
    ASSERT_EQ(collector.opacity.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(collector.opacity[i], 0.8f * (1 - moment.dust.age[i] / 5), 1e-6f);
}

TEST(Billboard, FollowsACloudThatComesAndGoes) {
    Moment empty(0), few(10), many(5'000);
    const auto method = prepared(empty, {});
    EXPECT_EQ(method->primitives(), 0);
    const pictures::Image first = few.updateAndDraw(*method);
    EXPECT_EQ(method->primitives(), 10);
    (void)many.updateAndDraw(*method);
    EXPECT_EQ(method->primitives(), 5'000);
    const pictures::Image nothing = empty.updateAndDraw(*method);
    EXPECT_EQ(method->primitives(), 0);
    for (const glm::vec4& pixel : nothing.pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(few.updateAndDraw(*method).pixels, first.pixels);
}

TEST(Billboard, HoldsFewBytesAParticleAndNoMoreEachFrame) {
    const std::size_t count = 200'000;
    Moment moment(count);
    for (std::size_t i = 0; i < count; ++i) moment.dust.radius[i] = 0.01f;
    const auto method = prepared(moment, {});
    (void)moment.updateAndDraw(*method);
    const auto total = [&] {
        MemoryUse sum;
        for (const MemoryUse& use : method->memory()) {
            sum.cpuBytes += use.cpuBytes;
            sum.gpuBytes += use.gpuBytes;
        }
        return sum;
    };
    const MemoryUse warm = total();
    EXPECT_LE(warm.cpuBytes, 24 * count);
    EXPECT_GE(warm.gpuBytes, 20 * count);
    (void)moment.updateAndDraw(*method);
    EXPECT_EQ(total().cpuBytes, warm.cpuBytes);
    EXPECT_EQ(total().gpuBytes, warm.gpuBytes);
}

TEST(Billboard, ReportsSortAndUploadAsStages) {
    class Listener final : public StageListener {
     public:
        void begin(Stage stage) override { begun.push_back(stage); }
        void end(Stage) override { ++ended; }
        void beginDetail(std::string_view name) override { details.emplace_back(name); }
        void endDetail(std::string_view) override {}
        std::vector<Stage> begun;
        std::vector<std::string> details;
        std::size_t ended = 0;
    } listener;
    Moment moment(10);
    const auto method = prepared(moment, {});
    const StageClock clock(&listener);
    method->update(moment.frame(clock));
    EXPECT_EQ(listener.begun, (std::vector<Stage>{Stage::sort, Stage::upload}));
    EXPECT_EQ(listener.ended, 2u);
    const auto inTiles = prepared(moment, {{"raster", "tiles"}});
    inTiles->update(moment.frame(clock));
    (void)moment.picture([&](gpu::Layer& layer) { inTiles->draw(moment.frame(clock), layer); });
    EXPECT_EQ(listener.details, (std::vector<std::string>{"bin", "blend"}));
}

}  // namespace
}  // namespace dustbench::billboard
