// Draws the ground: lattice, textures, the worn track on level ground, and the areas where shadows may fall.
//
// Units: metres. Owns: its buffers, textures and programs. The caller binds the moment's uniform block.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/draw/ground_lattice.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

class GroundPass {
 public:
    /// `device` and `scene` must outlive the pass.
    GroundPass(gpu::Device& device, const scene::Scene& scene);

    /// Draws the ground's colour and depth as seen from `eye`. Shadows are sampled only within `shaded`, where the
    /// ground is drawn a second time; this is cheaper than sampling shadows everywhere. If `lamps`, the bound lamps
    /// light it too.
    void draw(const glm::dvec3& eye, const glm::mat4& eyeToClip, std::span<const GroundRectangle> shaded, bool lamps);

    /// Mean albedo of the ground.
    [[nodiscard]] DUSTBENCH_API static glm::vec3 albedo(const scene::Scene& scene);

 private:
    struct Programs {
        Programs(gpu::Device& device, const scene::Scene& scene, bool lamps);
        gpu::Program plain, track, shaded;  ///< `track` is empty if the ground has none
    };

    void place(gpu::Program& program, const glm::dvec3& eye, bool withTrack);
    void drawTrack(gpu::Program& program);
    void drawShadedRectangles(gpu::Program& program, std::span<const GroundRectangle> shaded);
    void drawShadedTriangles(gpu::Program& program, std::span<const GroundRectangle> shaded);

    gpu::Device& device_;
    const scene::Scene& scene_;
    bool hasTrack_;
    GroundLattice lattice_;
    gpu::Texture detail_;
    gpu::Texture patches_;
    Programs programs_;
    std::optional<Programs> withLamps_;  ///< made for the first lamp

    gpu::Buffer vertices_;
    gpu::Buffer visible_;
    gpu::Buffer shadedIndices_;
    gpu::Buffer rectangles_;
    gpu::Buffer trackVertices_;
    gpu::VertexArray latticeLayout_;
    gpu::VertexArray shadedLayout_;
    gpu::VertexArray rectangleLayout_;
    gpu::VertexArray trackLayout_;
    std::vector<std::uint32_t> indices_;
    std::vector<GroundVertex> corners_;
};

// --- Textures of the ground, near and far: two seamless noise-based tiles of packed dirt with gravel.
//
// The first contains grains and stones as albedo with the relief's shading baked in. The second contains patches of
// tens of metres, which hide the repetition of the first. The same arguments give the same tiles.

inline constexpr int detailTexels = 512;
inline constexpr double detailTileMetres = 4;
inline constexpr int patchTexels = 512;
/// A whole number of detail tiles, so that one phase serves both.
inline constexpr double patchTileMetres = 256;

/// RGBA, sRGB encoded; the mean in linear light is `albedo`. `toSun` gives the direction of the light on the relief.
[[nodiscard]] std::vector<std::uint8_t> makeGroundDetail(glm::vec3 albedo, glm::vec3 toSun);

/// RGBA, linear: factors of the albedo; 128 stands for 1. Made by the first call.
[[nodiscard]] const std::vector<std::uint8_t>& groundPatches();

}  // namespace dustbench::draw
