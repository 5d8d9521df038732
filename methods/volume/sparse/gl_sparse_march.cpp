#include "methods/volume/sparse/gl_sparse_march.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "methods/contract/errors.h"
#include "methods/kit/gpu/draw_call.h"
#include "raycast_shaders.h"
#include "volume_sparse_shaders.h"

namespace dustbench::volume {
namespace {

/// The system's copy from NanoVDB, embedded at build time. The buffer that it reads must be declared before it.
constexpr gpu::ShaderFile pnanovdb{"volume_sparse/PNanoVDB.glsl", volume_sparse_shaders::PNanoVDB_h.text};

}  // namespace

void requireTreesFit(std::size_t treeBytes, std::size_t maximumBytes) {
    // PNanoVDB.h is used with 32-bit addresses, and the shader computes signed differences of them.
    const std::size_t allowed = std::min<std::size_t>(maximumBytes, std::numeric_limits<std::int32_t>::max());
    if (treeBytes > allowed)
        throw InputError(
            fmt::format("storage=sparse: the volume takes {:.1f} MB on the GPU, allowed: {:.1f} MB, the largest "
                        "storage buffer of this OpenGL driver; backend=cpu has no such limit",
                        static_cast<double>(treeBytes) / 1e6, static_cast<double>(allowed) / 1e6));
}

GlSparseMarch::GlSparseMarch(gpu::Device& device, const raycast::RaycastSettings& settings)
    : device_(device), settings_(settings), optics_(device, settings), vertices_(device) {}

void GlSparseMarch::upload(const SparseMoment& moment, const raycast::LightVolume* light) {
    const std::span<const std::byte> density = moment.density.bytes(), reaction = moment.reaction.bytes();
    const std::size_t bytes = density.size() + reaction.size();
    requireTreesFit(bytes, device_.maximumStorageBytes());
    optics_.set(moment.spacingMetres, !moment.reaction.empty(), light);
    if (trees_.bytes() < bytes || trees_.bytes() > 2 * bytes) trees_ = gpu::Buffer(device_, "sparse volume", bytes);
    trees_.write(density);
    trees_.writeFrom(density.size(), reaction);
}

gpu::Program& GlSparseMarch::program() {
    std::optional<gpu::Program>& made = optics_.burning() ? withFire_ : smokeAlone_;
    if (!made) {
        std::map<std::string, std::string> definitions = optics_.definitions();
        if (settings_.jitter) definitions["JITTER"] = "";
        if (settings_.skipEmpty) definitions["SKIP"] = "";
        made.emplace(
            device_, "sparse march",
            std::initializer_list<gpu::ShaderFile>{
                volume_sparse_shaders::sparse_buffer_glsl, pnanovdb, volume_sparse_shaders::sparse_cells_glsl,
                raycast_shaders::grid_optics_glsl, raycast_shaders::rectangle_vert, raycast_shaders::grid_march_frag},
            definitions);
    }
    return *made;
}

void GlSparseMarch::draw(const SparseMoment& moment, const raycast::PixelRectangle& pixels,
                         const raycast::Reflected& reflected, const scene::View& view, const gpu::Layer& layer) {
    const raycast::PixelRays rays(moment.place(), view);
    gpu::Program& program = this->program();
    optics_.bind(program, reflected, /*thickness=*/1);
    program.set("cells", glm::vec3(moment.cells));
    program.set("firstCell", moment.firstCell);
    if (optics_.burning()) program.set("reactionTree", static_cast<int>(moment.density.bytes().size()));
    if (settings_.skipEmpty) {
        program.set("minimum", glm::vec3(moment.minimum()));
        program.set("maximum", glm::vec3(moment.maximum()));
    }
    program.set("eye", rays.eye);
    program.set("rayCorner", rays.corner);
    program.set("rayRight", rays.right);
    program.set("rayUp", rays.up);
    program.set("nearDistance", rays.nearDistance);
    program.set("stepLength", static_cast<float>(settings_.stepCells));
    program.set("opaqueDepth", raycast::opaqueDepth(settings_));
    program.set("rectangle", pixels.inClipSpace(layer.width(), layer.height()));

    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    trees_.bindStorage(0);
    gpu::draw(program, vertices_, state, gpu::Primitives::triangleStrip, 4);
}

}  // namespace dustbench::volume
