// One frame of dust in front of an eye, for tests and benchmarks of whole methods.
//
// Owns: the dust, and what draw/test_canvas.h owns. The test fills in the dust.
#pragma once

#include "methods/contract/method.h"
#include "methods/contract/scene.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench {

class TestMoment : public draw::TestCanvas {
 public:
    TestMoment(std::size_t count, int width, int height, const glm::dvec3& eye, const glm::dvec3& along)
        : TestCanvas(width, height, eye, along), dust(ledger_) {
        dust.resize(count);
    }

    [[nodiscard]] Frame frame() const { return frame(untimed_); }
    [[nodiscard]] Frame frame(const StageClock& clock) const { return {0, 1.0 / 60, state, dust, view, clock}; }
    pictures::Image draw(Method& method) {
        return picture([&](gpu::Layer& layer) { method.draw(frame(), layer); });
    }
    pictures::Image updateAndDraw(Method& method) {
        method.update(frame());
        return draw(method);
    }

    scene::Scene scene;
    scene::SceneState state;

 private:
    MemoryLedger ledger_;
    StageClock untimed_;

 public:
    particles::ParticleStore dust;
};

}  // namespace dustbench
