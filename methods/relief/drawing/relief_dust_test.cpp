// The shadow of dust on a relief.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/draw/test_canvas.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/relief/drawing/relief_pass.h"

namespace dustbench::relief {
namespace {

/// A tilted panel of random hills, seen from its front by a sun below the horizon, so that the ground gives no light
/// back.
class ShadedPanel {
 public:
    ShadedPanel() {
        auto relief = std::make_shared<scene::Relief>();
        relief->columns = 37;
        relief->rows = 29;
        std::mt19937 random(4);
        std::uniform_real_distribution<float> any(0, 1);
        for (int i = 0; i < relief->columns * relief->rows; ++i) relief->depth.push_back(any(random));
        relief->colour.assign(relief->depth.size(), glm::vec3(0.5f));
        panel_.sizeMetres = {2, 1.5};
        panel_.depthMetres = 0.1;
        panel_.toParent = glm::rotate(glm::translate(glm::dmat4(1), {3, 1.5, -2}), 0.7, {0.2, 1, 0.1});
        panel_.relief = relief;
        scene.lights.hazePerMetre = 0;
        scene.lights.toSun = glm::normalize(glm::vec3(panel_.toParent * glm::dvec4(0.2, -0.5, 1, 0)));
        view_.width = 80;
        view_.height = 60;
        view_.camera.eye = glm::dvec3(panel_.toParent * glm::dvec4(0.3, 0.2, 2.5, 1));
        view_.camera.target = glm::dvec3(panel_.toParent * glm::dvec4(0, 0, -0.05, 1));
        view_.camera.nearMetres = 0.01;
    }
    [[nodiscard]] pictures::Image drawn(March march, const draw::DustShadow* dust) const {
        MemoryLedger ledger;
        WornSurface surface(*panel_.relief, ledger);
        const DepthPyramid pyramid(surface.depths(), ledger);
        gpu::Device& device = draw::TestCanvas::device();
        ReliefPass pass(device, scene, panel_, pyramid,
                        {.march = march, .shadow = false, .dustShadow = dust != nullptr});
        static_cast<void>(pass.upload(surface, pyramid, surface.takeChanged()));
        gpu::Texture far = gpu::Texture::make2D(device, "far", gpu::Format::depth32F, view_.width, view_.height);
        far.write(
            std::span<const float>(std::vector<float>(static_cast<std::size_t>(view_.width * view_.height), 0.0f)));
        SceneWithReliefs target(device, view_.width, view_.height);
        target.begin(far);
        pass.draw(view_, panel_.toParent, nullptr, dust);
        return draw::readBack(target.layer().colour());
    }
    [[nodiscard]] glm::vec3 place() const { return glm::vec3(panel_.toParent[3]); }

    scene::Scene scene;

 private:
    scene::Panel panel_;
    scene::View view_;
};

TEST(ReliefDust, DimsTheSunAlone) {
    ShadedPanel panel;
    ASSERT_LT(panel.scene.lights.toSun.y, 0);
    constexpr double depth = 0.8;
    MemoryLedger ledger;
    particles::ParticleStore dust(ledger);
    dust.resize(1);  // so wide that its depth is the same all over the panel
    const glm::vec3 place = panel.place() + 300.0f * panel.scene.lights.toSun;
    dust.x[0] = place.x, dust.y[0] = place.y, dust.z[0] = place.z;
    dust.radius[0] = 100;
    dust.opacity[0] = static_cast<float>(-std::expm1(-depth));
    draw::DustShadow shadow(draw::TestCanvas::device(), panel.scene.lights.toSun);
    shadow.set(dust);

    for (const March march : {March::safe, March::mesh}) {
        const pictures::Image clear = panel.drawn(march, nullptr), dimmed = panel.drawn(march, &shadow);
        const glm::vec3 sun = panel.scene.lights.sun;
        panel.scene.lights.sun = glm::vec3(0);
        const pictures::Image dark = panel.drawn(march, nullptr);
        panel.scene.lights.sun = sun;
        std::size_t compared = 0;
        for (std::size_t i = 0; i < clear.pixels.size(); ++i) {
            const float lost = clear.pixels[i].g - dimmed.pixels[i].g, whole = clear.pixels[i].g - dark.pixels[i].g;
            if (clear.pixels[i].a == 0 || whole < 0.05f) continue;
            ++compared;
            ASSERT_NEAR(lost / whole, 1 - std::exp(-depth), 0.01) << i;
        }
        EXPECT_GT(compared, 500u);
    }
}

}  // namespace
}  // namespace dustbench::relief
