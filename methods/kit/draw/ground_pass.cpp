#include "methods/kit/draw/ground_pass.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <string>

#include "draw_shaders.h"
#include "methods/kit/draw/ground_texture.h"
#include "methods/kit/draw/opaque_definitions.h"
#include "methods/kit/gpu/draw_call.h"

namespace dustbench::draw {
namespace {

/// Packed ground is darker than the dust that comes off it.
constexpr float packedShare = 0.52f;

/// Half the width of the strip with the track's ruts, and the cuts along its length, which keep each triangle's depth
/// range short.
constexpr float trackHalfWidthMetres = 2.7f;
constexpr std::array<float, 13> trackCutsMetres{-4096, -1024, -256, -64, -16, -4, 0, 4, 16, 64, 256, 1024, 4096};

bool hasTrack(const scene::Scene& scene) {
    return scene.terrain.isFlat() && scene.vehicle;
}

std::map<std::string, std::string> groundDefinitions(const scene::Scene& scene, bool lamps, bool track, bool shaded) {
    std::map<std::string, std::string> result = opaqueDefinitions(scene, lamps);
    result.insert({
        {"DETAIL_TILES", std::to_string(patchTileMetres / detailTileMetres)},
        {"TILES_PER_METRE", std::to_string(1 / patchTileMetres)},
        {"PATCH_SCALE", std::to_string(255.0 / 128)},
    });
    if (!scene.terrain.isFlat()) result.emplace("RELIEF", "1");
    if (track) result.emplace("TRACK", "1");
    if (shaded) result.emplace("SHADED", "1");
    return result;
}

gpu::Program groundProgram(gpu::Device& device, std::string_view label, const scene::Scene& scene, bool lamps,
                           bool track, bool shaded) {
    using namespace draw_shaders;
    return {device,
            label,
            {opaque_moment_glsl, opaque_shadow_glsl, error_function_glsl, opaque_dust_glsl, opaque_lamps_glsl,
             opaque_ground_vert, opaque_ground_frag},
            groundDefinitions(scene, lamps, track, shaded)};
}

gpu::VertexArray layoutOf(gpu::Device& device, const gpu::Buffer& vertices) {
    gpu::VertexArray layout(device);
    layout.attribute(0, 3, vertices, sizeof(GroundVertex), offsetof(GroundVertex, position));
    layout.attribute(1, 3, vertices, sizeof(GroundVertex), offsetof(GroundVertex, normal));
    return layout;
}

/// Replaces a buffer's contents without waiting for draws that still read the old ones.
template <typename T>
void refill(gpu::Buffer& buffer, const std::vector<T>& values) {
    if (values.empty()) return;
    const std::size_t bytes = values.size() * sizeof(T);
    std::memcpy(buffer.mapForWriting(bytes), values.data(), bytes);
    buffer.unmap();
}

void appendRectangle(std::vector<GroundVertex>& corners, const glm::vec2& minimum, const glm::vec2& maximum) {
    const glm::vec3 up(0, 1, 0);
    const GroundVertex a{{minimum.x, 0, minimum.y}, up}, b{{maximum.x, 0, minimum.y}, up};
    const GroundVertex c{{minimum.x, 0, maximum.y}, up}, d{{maximum.x, 0, maximum.y}, up};
    corners.insert(corners.end(), {a, c, d, a, d, b});
}

}  // namespace

glm::vec3 GroundPass::albedo(const scene::Scene& scene) {
    return packedShare * scene.dustAlbedo;
}

GroundPass::Programs::Programs(gpu::Device& device, const scene::Scene& scene, bool lamps)
    : plain(groundProgram(device, "ground", scene, lamps, false, false)),
      shaded(groundProgram(device, "ground in shadow", scene, lamps, hasTrack(scene), true)) {
    if (hasTrack(scene)) track = groundProgram(device, "ground track", scene, lamps, true, false);
}

GroundPass::GroundPass(gpu::Device& device, const scene::Scene& scene)
    : device_(device),
      scene_(scene),
      hasTrack_(hasTrack(scene)),
      lattice_(scene.terrain),
      detail_(gpu::Texture::make2D(device, "ground detail", gpu::Format::srgba8, detailTexels, detailTexels,
                                   gpu::Filter::mipmapped, gpu::Wrap::repeat)),
      patches_(gpu::Texture::make2D(device, "ground patches", gpu::Format::rgba8, patchTexels, patchTexels,
                                    gpu::Filter::mipmapped, gpu::Wrap::repeat)),
      programs_(device, scene, false) {
    detail_.write(std::span<const std::uint8_t>(makeGroundDetail(albedo(scene), scene.lights.toSun)));
    patches_.write(std::span<const std::uint8_t>(makeGroundPatches()));

    lattice_.moveTo(glm::dvec3(0));
    vertices_ = gpu::Buffer(device, "ground vertices", lattice_.vertices());
    visible_ = gpu::Buffer(device, "ground indices", lattice_.maximumIndices() * sizeof(std::uint32_t));
    latticeLayout_ = layoutOf(device, vertices_);
    latticeLayout_.indices(visible_);
    if (!scene.terrain.isFlat()) {
        shadedIndices_ = gpu::Buffer(device, "ground in shadow", lattice_.maximumIndices() * sizeof(std::uint32_t));
        shadedLayout_ = layoutOf(device, vertices_);
        shadedLayout_.indices(shadedIndices_);
    }
    if (hasTrack_) {
        trackVertices_ = gpu::Buffer(device, "ground track", (trackCutsMetres.size() - 1) * 6 * sizeof(GroundVertex));
        trackLayout_ = layoutOf(device, trackVertices_);
    }
}

void GroundPass::place(gpu::Program& program, const glm::dvec3& eye, bool withTrack) {
    const glm::dvec3& anchor = lattice_.anchor();
    const glm::dvec2 tiles = glm::dvec2(anchor.x, anchor.z) / patchTileMetres;
    program.set("anchorFromEye", glm::vec3(anchor - eye));
    program.set("anchorPhase", glm::vec2(tiles - glm::floor(tiles)));
    if (withTrack) program.set("anchorAcross", static_cast<float>(anchor.z));
}

void GroundPass::draw(const glm::dvec3& eye, const glm::mat4& eyeToClip, std::span<const GroundRectangle> shaded,
                      bool lamps) {
    if (lamps && !withLamps_) withLamps_.emplace(device_, scene_, true);
    Programs& programs = lamps ? *withLamps_ : programs_;
    if (lattice_.moveTo(eye)) {
        const auto vertices = lattice_.vertices();
        std::memcpy(vertices_.mapForWriting(vertices.size_bytes()), vertices.data(), vertices.size_bytes());
        vertices_.unmap();
    }
    glm::mat4 anchorToEye(1);
    anchorToEye[3] = glm::vec4(glm::vec3(lattice_.anchor() - eye), 1);
    indices_.clear();
    lattice_.appendVisible(eyeToClip * anchorToEye, indices_);
    refill(visible_, indices_);

    detail_.bind(0);
    patches_.bind(1);
    place(programs.plain, eye, false);
    gpu::drawIndexed(programs.plain, latticeLayout_, {.depthTest = true, .depthWrite = true},
                     gpu::Primitives::triangles, static_cast<int>(indices_.size()));
    if (hasTrack_) {
        place(programs.track, eye, true);
        drawTrack(programs.track);
    }
    if (shaded.empty()) return;
    place(programs.shaded, eye, hasTrack_);
    if (scene_.terrain.isFlat())
        drawShadedRectangles(programs.shaded, shaded);
    else
        drawShadedTriangles(programs.shaded, shaded);
}

void GroundPass::drawTrack(gpu::Program& program) {
    // The track needs no depth test: level ground does not occlude itself and is drawn first.
    const auto across = static_cast<float>(-lattice_.anchor().z);
    corners_.clear();
    for (std::size_t i = 0; i + 1 < trackCutsMetres.size(); ++i)
        appendRectangle(corners_, {trackCutsMetres[i], across - trackHalfWidthMetres},
                        {trackCutsMetres[i + 1], across + trackHalfWidthMetres});
    refill(trackVertices_, corners_);
    gpu::draw(program, trackLayout_, {}, gpu::Primitives::triangles, static_cast<int>(corners_.size()));
}

void GroundPass::drawShadedRectangles(gpu::Program& program, std::span<const GroundRectangle> shaded) {
    const glm::dvec2 anchor(lattice_.anchor().x, lattice_.anchor().z);
    corners_.clear();
    for (const GroundRectangle& rectangle : shaded)
        appendRectangle(corners_, glm::vec2(rectangle.minimum - anchor), glm::vec2(rectangle.maximum - anchor));
    if (const std::size_t bytes = corners_.size() * sizeof(GroundVertex); bytes > rectangles_.bytes()) {
        rectangles_ = gpu::Buffer(device_, "ground in shadow", 2 * bytes);
        rectangleLayout_ = layoutOf(device_, rectangles_);
    }
    refill(rectangles_, corners_);
    gpu::draw(program, rectangleLayout_, {}, gpu::Primitives::triangles, static_cast<int>(corners_.size()));
}

void GroundPass::drawShadedTriangles(gpu::Program& program, std::span<const GroundRectangle> shaded) {
    // The same triangles as in the first pass, so that their depths are bit-identical.
    indices_.clear();
    lattice_.appendWithin(shaded, indices_);
    refill(shadedIndices_, indices_);
    gpu::drawIndexed(program, shadedLayout_, {.depthTest = true}, gpu::Primitives::triangles,
                     static_cast<int>(indices_.size()));
}

}  // namespace dustbench::draw
