// Draws the opaque scene: sky and sun, textured ground, solids, panels, the vehicle with its wheels, and shadows. With
// hidden scenery, only the horizon's colour.
//
// Units: linear colour, scene metres. Depth: reversed, 32-bit float. Owns: its colour and depth targets.
#pragma once

#include <memory>
#include <span>

#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

/// How the scene's panels appear: flat, or not at all because a method draws them. They cast shadows either way.
enum class ScenePanels { flat, hidden };

/// Hidden: draws nothing and allocates nothing for drawing. colour() is the horizon's, and depth() is infinitely far.
enum class Scenery { drawn, hidden };

class DUSTBENCH_API OpaqueScene {
 public:
    OpaqueScene(const scene::Scene& scene, gpu::Device& device, int width, int height,
                ScenePanels panels = ScenePanels::flat);
    OpaqueScene(const scene::Scene& scene, gpu::Device& device, int width, int height, ScenePanels panels,
                Scenery scenery);
    ~OpaqueScene();
    OpaqueScene(const OpaqueScene&) = delete;
    OpaqueScene& operator=(const OpaqueScene&) = delete;

    /// Sets the size of the pictures; colour() and depth() then return new textures.
    void resize(int width, int height);

    /// Draws the given state into colour() and depth(). `view` must have the scene's size. `lamps` light it in addition
    /// to the sun and the sky: Lambert's law, no shadows. Without lamps the picture is the same, bit for bit. `dust`
    /// casts a shadow if scene::Lights::onDust.
    void draw(const scene::SceneState& state, const scene::View& view, std::span<const scene::PointLight> lamps = {},
              const Puffs& dust = {});

    [[nodiscard]] const gpu::Texture& colour() const;  ///< RGBA16F, linear, alpha 1
    [[nodiscard]] const gpu::Texture& depth() const;   ///< Depth32F

 private:
    struct Targets;
    struct State;
    std::unique_ptr<Targets> targets_;
    std::unique_ptr<State> state_;  ///< null if the scenery is hidden
    glm::vec3 background_{0};       ///< used instead
};

}  // namespace dustbench::draw
