// A preset next to a vehicle at different speeds: equally many particles, and the same picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/claims/experiments.h"
#include "bench/measure/image/picture_error.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/voxel_shape/voxel_shape.h"

namespace dustbench::voxel_shape {
namespace {

constexpr int width = 160, height = 120;
constexpr int frames = 30;

struct Shown {
    std::int64_t primitives = 0;
    pictures::Image layer;
};

/// A shape after its 30th frame, seen from a fixed position in the shape's own frame.
Shown shownAt(const std::string& shape, const std::string& speed, const std::string& preroll = "1.5") {
    claims::ProgramContext context(1);
    const auto world =
        context.world("plain", {{"particles", "10"}, {"preroll", preroll}, {"speed", speed}}, width, height);
    const MethodInfo info = voxel_shape::describe();
    ParameterValues values(info.parameters);
    values.set("shape", shape);
    const std::unique_ptr<Method> method = info.create(values);
    draw::TestCanvas canvas(width, height, {0, 0, 0}, {1, 0, 0});
    method->prepare(world->scene(), world->setup(), draw::TestCanvas::device());
    const Pose& pose = dynamic_cast<const VoxelShape&>(*method).system().pose();
    const int steps = static_cast<int>(std::stod(preroll) * 60) + frames;
    for (int step = 0; step < steps; ++step) {
        const Frame frame = world->step();
        canvas.view.camera = frame.view.camera;
        method->update({frame.index, frame.stepSeconds, frame.state, frame.dust, canvas.view, frame.clock});
    }
    canvas.lookFrom(glm::dvec3(pose.toWorld({3.2f, 2.2f, 4.2f})),
                    glm::dvec3(pose.rotation * glm::vec3(-3.2f, -0.7f, -4.2f)));
    const Frame last = world->step();
    const Frame seen{last.index, last.stepSeconds, last.state, last.dust, canvas.view, last.clock};
    return {method->primitives(), canvas.picture([&](gpu::Layer& layer) { method->draw(seen, layer); })};
}

measure::Picture over(const pictures::Image& layer, float grey) {
    pictures::Image ground = layer;
    std::ranges::fill(ground.pixels, glm::vec4(grey, grey, grey, 1));
    return measure::preparePicture(pictures::over(layer, ground), "layer");
}

void expectTheSameAtEverySpeed(const std::string& shape) {
    const Shown slow = shownAt(shape, "0.5");
    const auto covered = std::ranges::count_if(slow.layer.pixels, [](const glm::vec4& p) { return p.a > 0.1f; });
    EXPECT_GT(covered, width * height / 40) << "it is in the picture";
    for (const char* speed : {"4", "20", "40"}) {
        const Shown fast = shownAt(shape, speed);
        const double ratio = static_cast<double>(fast.primitives) / static_cast<double>(slow.primitives);
        EXPECT_NEAR(ratio, 1, 0.01) << shape << " at " << speed << " m/s";
        testing::Test::RecordProperty(shape + "_primitives_at_" + speed, std::to_string(fast.primitives));
        for (const float grey : {0.0f, 0.2f, 1.0f}) {
            const measure::Measured flip = measure::flip(over(slow.layer, grey), over(fast.layer, grey));
            EXPECT_LT(*flip.value, 0.02) << shape << " at " << speed << " m/s over " << grey;
            testing::Test::RecordProperty(shape + "_flip_at_" + speed + "_over_" + std::to_string(grey),
                                          std::to_string(*flip.value));
        }
    }
}

TEST(MovingShapes, OfTheFigureAreTheSameAtEverySpeed) {
    expectTheSameAtEverySpeed("figure");
}

TEST(MovingShapes, OfTheCarAreTheSameAtEverySpeed) {
    expectTheSameAtEverySpeed("car");
}

TEST(MovingShapes, LeaveNothingBehindFromTheFirstStepOn) {
    const Shown slow = shownAt("figure", "0.5", "0"), fast = shownAt("figure", "40", "0");
    EXPECT_NEAR(static_cast<double>(fast.primitives) / static_cast<double>(slow.primitives), 1, 0.01);
}

}  // namespace
}  // namespace dustbench::voxel_shape
