#include "bench/reference/reference_store.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "bench/reference/test_clouds.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::reference {
namespace {

namespace fs = std::filesystem;

/// All inputs of a reference image, with a change to each.
struct Inputs {
    MemoryLedger ledger;
    particles::ParticleStore dust = test::ball(ledger, 5, 40, {0, 1, 0}, 3, 0.4f);
    scene::View view = test::viewFrom({0, 2, 9}, {0, 1, 0});
    OpaqueDistances distances = test::groundDistances(view, 0);
    std::optional<SunLight> light;
    ReferenceOptions options;

    Inputs() { dust.uniformColour = true; }
    pictures::Image from(ReferenceStore& store) const { return store.render(dust, view, distances, light, options); }
};

std::vector<std::function<void(Inputs&)>> changes() {
    return {[](Inputs& to) { to.dust.x[7] += 0.5f; },
            [](Inputs& to) { to.dust.y[7] += 0.5f; },
            [](Inputs& to) { to.dust.z[7] += 0.5f; },
            [](Inputs& to) { to.dust.radius[7] *= 1.5f; },
            [](Inputs& to) { to.dust.opacity[7] *= 1.5f; },
            [](Inputs& to) { to.dust.resize(30); },
            [](Inputs& to) { to.dust.colourOfAll.g = 0.1f; },
            [](Inputs& to) {
                to.dust.uniformColour = false;
                to.dust.red.assign(to.dust.size(), 0.3f);
                to.dust.green.assign(to.dust.size(), 0.5f);
                to.dust.blue.assign(to.dust.size(), 0.7f);
            },
            [](Inputs& to) { to.view.camera.eye.x += 0.1; },
            [](Inputs& to) { to.view.camera.target.x += 0.1; },
            [](Inputs& to) {
                to.view.camera.up = {1, 1, 0};
            },
            [](Inputs& to) { to.view.camera.verticalFieldOfView *= 0.9; },
            [](Inputs& to) { to.distances = skyDistances(to.view); },
            [](Inputs& to) { to.light = SunLight{}; },
            [](Inputs& to) { to.light = SunLight{.sun = glm::dvec3(0.5)}; },
            [](Inputs& to) { to.light = SunLight{.ambient = glm::dvec3(0.5)}; },
            [](Inputs& to) { to.light = SunLight{.asymmetry = 0.5}; },
            [](Inputs& to) {
                to.light = SunLight{.toSun = {1, 1, 0}};
            },
            [](Inputs& to) { to.light = SunLight{.albedo = glm::dvec3(0.2)}; },
            [](Inputs& to) { to.options.opticalDepthShare = 0.5; },
            [](Inputs& to) {
                to.light = SunLight{};  // without it, the same image as of the distances above
                to.options.ignoreScene = true;
            },
            [](Inputs& to) { to.options.toleratedDepth = 0.1; },
            [](Inputs& to) {
                to.light = SunLight{};
                to.options.slabMetres = 1;
            }};
}

TEST(ReferenceStore, GivesTheRenderedImageWhateverInputChanges) {
    const TestFolder folder;
    ReferenceStore none;
    std::set<std::string> images;
    const auto check = [&](const Inputs& inputs, const std::string& what) {
        ReferenceStore first(folder.path()), second(folder.path());  // as two runs
        const pictures::Image expected = inputs.from(none);
        EXPECT_EQ(inputs.from(first).pixels, expected.pixels) << what;
        EXPECT_EQ(inputs.from(second).pixels, expected.pixels) << what;
        EXPECT_EQ(first.found(), 0) << what;
        EXPECT_EQ(second.found(), 1) << what;
        const std::string bytes(reinterpret_cast<const char*>(expected.pixels.data()),
                                expected.pixels.size() * sizeof(glm::vec4));
        EXPECT_TRUE(images.insert(bytes).second) << what << ": a change that changes no image tests nothing";
    };
    check({}, "unchanged");
    std::size_t n = 0;
    for (const auto& change : changes()) {
        Inputs inputs;
        change(inputs);
        check(inputs, "change " + std::to_string(n++));
    }
    EXPECT_EQ(none.found(), 0);
}

TEST(ReferenceStore, RendersWhereAFileIsDamagedOrTheFolderCannotBeMade) {
    const TestFolder folder;
    const Inputs inputs;
    ReferenceStore none, store(folder.path() / "images");
    const auto expected = inputs.from(none).pixels;
    (void)inputs.from(store);
    for (const auto& entry : fs::directory_iterator(folder.path() / "images")) fs::resize_file(entry.path(), 100);
    EXPECT_EQ(inputs.from(store).pixels, expected);
    EXPECT_EQ(store.found(), 0);
    EXPECT_EQ(inputs.from(store).pixels, expected);
    EXPECT_EQ(store.found(), 1) << "it is stored again";
    ReferenceStore nowhere("/proc/none");
    EXPECT_EQ(inputs.from(nowhere).pixels, expected);
}

TEST(ReferenceStore, RemovesTheOldestImagesAboveItsLimit) {
    const TestFolder folder;
    Inputs inputs;
    const std::uintmax_t image = sizeof(glm::vec4) * inputs.distances.metres.size();
    for (int n = 0; n < 9; ++n) {
        ReferenceStore store(folder.path(), 4 * image);
        inputs.dust.x[0] = static_cast<float>(n);
        (void)inputs.from(store);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 4);
    ReferenceStore store(folder.path(), 4 * image);
    (void)inputs.from(store);
    EXPECT_EQ(store.found(), 1) << "the newest stays";
    ReferenceStore small(folder.path(), image - 1);
    inputs.dust.x[0] = 20;
    (void)inputs.from(small);
    (void)inputs.from(small);
    EXPECT_EQ(small.found(), 0) << "no image fits";
}

}  // namespace
}  // namespace dustbench::reference
