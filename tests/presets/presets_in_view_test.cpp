// Every delivered shape and particle system is visible: particles are within the view of the default camera, and cover
// pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/claims/experiments.h"
#include "methods/contract/registry.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench {
namespace {

constexpr int width = 160, height = 120;

/// The scene and camera of a preset: those that its file names, or the defaults of a run.
struct Place {
    const char *scene = "plain", *camera = "chase";
};

/// Counts the puffs whose centres are in the picture.
class InView final : public VolumeVisitor {
 public:
    explicit InView(const scene::View& view) : toClip_(view.worldToClip()) {}

    void puffs(const Puffs& puffs) override {
        all += puffs.size();
        for (std::size_t i = 0; i < puffs.size(); ++i) {
            const glm::vec4 clip = toClip_ * glm::vec4(puffs.position(i), 1);
            seen += clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w ? 1 : 0;
        }
    }
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}

    std::size_t all = 0, seen = 0;

 private:
    glm::mat4 toClip_;
};

/// Checks the current state of the method. `leastShare`: minimum share of the particles in the picture.
void expectSeen(Method& method, const Frame& frame, draw::TestCanvas& canvas, double leastShare) {
    EXPECT_GT(method.primitives(), 0);
    InView counted(frame.view);
    method.volume(frame, counted);
    EXPECT_GT(counted.all, 0u);
    EXPECT_GE(static_cast<double>(counted.seen), leastShare * static_cast<double>(counted.all))
        << counted.seen << " of " << counted.all;
    canvas.view = frame.view;
    const pictures::Image layer = canvas.picture([&](gpu::Layer& target) { method.draw(frame, target); });
    const auto covered = std::ranges::count_if(layer.pixels, [](const glm::vec4& p) {
        return std::max({p.r, p.g, p.b, p.a}) > 1.0f / 255;
    });
    EXPECT_GT(covered, width * height / 400);
}

/// Checks the first frame of a run, after a preroll, and a frame two seconds later, when a car has driven 40 m.
void expectInView(const char* method, const char* parameter, const std::string& preset, const Place& place,
                  int prerollSeconds, double leastShare) {
    SCOPED_TRACE(std::string(method) + ' ' + preset + " in " + place.scene);
    claims::ProgramContext context(1);
    const auto world = context.world(
        place.scene, {{"preroll", std::to_string(prerollSeconds)}, {"particles", "0"}, {"camera", place.camera}}, width,
        height);
    const MethodInfo& info = findMethod(method);
    ParameterValues values(info.parameters);
    values.set(parameter, preset);
    const std::unique_ptr<Method> shown = info.create(values);
    draw::TestCanvas canvas(width, height, {0, 0, 0}, {1, 0, 0});
    shown->prepare(world->scene(), world->setup(), draw::TestCanvas::device());
    const int first = 60 * prerollSeconds + 1, second = first + 120;
    for (int step = 1; step <= second; ++step) {
        const Frame frame = world->step();
        shown->update(frame);
        if (step == first || step == second) expectSeen(*shown, frame, canvas, leastShare);
    }
}

TEST(PresetsInView, OfEveryShape) {
    const std::vector<std::string> names = files::listData("shapes", ".toml");
    EXPECT_GE(names.size(), 16u);
    for (const std::string& name : names) {
        const Place place = name == "cloud" ? Place{"hand", "fixed"} : Place{};
        expectInView("voxel_shape", "shape", name, place, 1, 0.9);
    }
}

TEST(PresetsInView, OfEveryParticleSystem) {
    // Systems with a fixed position name their scene in their files; the others are dust from wheels.
    const Place dusk{"dusk", "fixed"};
    const std::map<std::string, Place> others{{"carr_dust", {}},
                                              {"wheel_dust", {}},
                                              {"flag", {}},
                                              {"boids", {"sphere", "fixed"}},
                                              {"cloth", {"sphere", "fixed"}},
                                              {"springs", {"sphere", "fixed"}},
                                              {"wheel_dust_mixed", {"two_soils", "chase"}},
                                              {"smoke", {"smoke", "fixed"}},
                                              {"smoke_fine", {"smoke_fine", "fixed"}},
                                              {"snow", {"snowfall", "fixed"}},
                                              {"rain", {"relief_rain", "fixed"}},
                                              {"sandstorm", {"relief_sandstorm", "fixed"}},
                                              {"acid", {"relief_acid", "fixed"}},
                                              {"torch", {"cascade", "fixed"}},
                                              {"waterfall", {"cascade", "fixed"}}};
    constexpr double leastShare = 0.1;  // snow falls over a wider area than the view, so that none is missing
    const std::vector<std::string> names = files::listData("particles", ".toml");
    EXPECT_GE(names.size(), 25u);
    for (const std::string& name : names) {
        const auto found = others.find(name);
        expectInView("plugin_particles", "system", name, found == others.end() ? dusk : found->second, 4, leastShare);
        if (name.starts_with("thesis_"))
            expectInView("plugin_particles", "system", name, {"void", "fixed"}, 4, leastShare);
    }
}

}  // namespace
}  // namespace dustbench
