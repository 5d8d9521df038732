#include "methods/volume/sparse/sparse_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/volume/sparse/nano_tree.h"
#include "methods/volume/sparse/nano_walk.h"
#include "raycast_shaders.h"
#include "volume_sparse_shaders.h"

namespace dustbench::volume {
namespace {

/// The system's copy from NanoVDB, embedded at build time. The buffer that it reads must be declared before it.
constexpr gpu::ShaderFile pnanovdb{"volume_sparse/PNanoVDB.glsl", volume_sparse_shaders::PNanoVDB_h.text};

// --- The input of a light volume (kit/raycast/light_volume.h), from the leaves of a sparse grid

/// The mean density of each block of `texelCells` cells of the box, x fastest. The density of a cell is multiplied by
/// its fire's extinction factor (`fire`: TransferFunction::table). Runs in parallel.
void meanDensities(const SparseMoment& moment, std::span<const glm::vec4> fire, int texelCells,
                   std::span<float> averages) {
    const glm::ivec3 texels = (moment.cells + texelCells - 1) / texelCells;
    const auto slab = static_cast<std::size_t>(texels.x) * static_cast<std::size_t>(texels.y);
    const NanoTree& tree = moment.density;
    std::ranges::fill(averages, 0.0f);
    // One slab of texels at a time, so that each is summed in a fixed order.
    parallel::forEachBlock(static_cast<std::size_t>(texels.z), 1, [&](std::size_t layer, std::size_t) {
        NanoWalk reactions(moment.reaction);
        const int low = static_cast<int>(layer) * texelCells, high = std::min(low + texelCells, moment.cells.z);
        for (std::size_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
            const glm::ivec3 first = tree.brickOf(leaf) * brickEdge - moment.firstCell;
            const int from = std::max(low - first.z, 0), to = std::min(high - first.z, brickEdge);
            if (from >= to) continue;
            const float* const values = tree.valuesOf(leaf);
            const float* const reaction = reactions.at(tree.brickOf(leaf)).values;
            for (int z = from; z < to; ++z)
                for (int y = 0; y < brickEdge; ++y)
                    for (int x = 0; x < brickEdge; ++x) {
                        const int i = x << 6 | y << 3 | z;
                        if (!(values[i] > 0)) continue;  // only cells in the box
                        float density = values[i];
                        if (!moment.reaction.empty()) {
                            const auto last = static_cast<float>(fire.size() - 1);
                            density *=
                                fire[static_cast<std::size_t>(std::lround((reaction ? reaction[i] : 0) * last))].a;
                        }
                        const glm::ivec3 texel = (first + glm::ivec3(x, y, z)) / texelCells;
                        averages[static_cast<std::size_t>(texel.x + texels.x * texel.y) + slab * layer] += density;
                    }
        }
        for (int y = 0; y < texels.y; ++y)
            for (int x = 0; x < texels.x; ++x) {
                const glm::ivec3 from = texelCells * glm::ivec3(x, y, static_cast<int>(layer));
                const glm::ivec3 size = glm::min(from + texelCells, moment.cells) - from;
                averages[static_cast<std::size_t>(x + texels.x * y) + slab * layer] /=
                    static_cast<float>(size.x * size.y * size.z);
            }
    });
}

/// Throws InputError if the light needs too many blocks, or more along an axis than a texture supports.
void requireLightFits(const SparseMoment& moment, int texelCells, bool onGpu) {
    constexpr double mostTexels = static_cast<double>(files::limits::volumeCells) / 8;
    constexpr int textureEdge = 2048;  // guaranteed by OpenGL 4.5
    const glm::dvec3 texels(((moment.cells - 1) / texelCells + 1));
    if (const double count = texels.x * texels.y * texels.z; count > mostTexels)
        throw InputError(
            fmt::format("storage=sparse: the box has {:.4g} blocks of shadow_cells={} for its light, allowed: "
                        "{:.4g}; increase shadow_cells",
                        count, texelCells, mostTexels));
    if (const double edge = std::max({texels.x, texels.y, texels.z}); onGpu && edge > textureEdge)
        throw InputError(
            fmt::format("storage=sparse: the box has {} blocks of shadow_cells={} along an axis for its light, "
                        "allowed by OpenGL: {}; increase shadow_cells",
                        edge, texelCells, textureEdge));
}

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

void requireSparse(const raycast::RaycastSettings& settings) {
    if (settings.renderer != raycast::Renderer::raycast)
        throw InputError("parameter renderer: got " + std::string(raycast::renderers.wordOf(settings.renderer)) +
                         " with storage=sparse, allowed: raycast");
    if (settings.filter != raycast::Filter::linear)
        throw InputError("parameter filter: got " + std::string(raycast::filters.wordOf(settings.filter)) +
                         " with storage=sparse, allowed: linear");
}

SparsePicture::SparsePicture(gpu::Device& device, const raycast::RaycastSettings& settings, const scene::Lights& lights,
                             MemoryLedger& ledger)
    : settings_(settings),
      reflected_(raycast::cloudColour(settings.smokeColour, lights, settings.asymmetry)),
      fire_(settings.fire.table()),
      march_(settings),
      composite_(device) {
    raycast::check(settings);
    requireSparse(settings);
    if (settings.shadowCells > 0) light_.emplace(settings, lights.toSun, ledger);
    const bool onCpu = settings.backend == raycast::Backend::cpu ||
                       (settings.backend == raycast::Backend::automatic && device.isSoftware());
    if (!onCpu) onGpu_.emplace(device, settings);
}

void SparsePicture::upload(const SparseMoment& moment) {
    moment_ = nullptr;
    if (moment.density.empty()) return;
    if (light_) {
        requireLightFits(moment, settings_.shadowCells, onGpu_.has_value());
        light_->set(moment.place(),
                    [&](std::span<float> averages) { meanDensities(moment, fire_, settings_.shadowCells, averages); });
    }
    const raycast::LightVolume* const light = light_ ? &*light_ : nullptr;
    if (onGpu_)
        onGpu_->upload(moment, light);
    else
        march_.set(moment, light);
    moment_ = &moment;
}

void SparsePicture::draw(const scene::View& view, const gpu::Layer& layer) {
    primitives_ = 0;
    if (!moment_) return;
    const raycast::PixelRectangle pixels =
        raycast::pixelsOf(moment_->place(), moment_->minimum(), moment_->maximum(), view);
    if (pixels.empty()) return;
    primitives_ = pixels.count();
    if (onGpu_) return onGpu_->draw(*moment_, pixels, reflected_, view, layer);
    raycast::SceneDepthCopy sceneDepth(layer);
    const raycast::SceneDepths depths = sceneDepth.depths();
    const raycast::PacketPicture picture = composite_.map(pixels, march_.channels());
    march_.march(raycast::PixelRays(moment_->place(), view), depths, reflected_, picture);
    composite_.draw(reflected_.all(), layer);
}

std::size_t SparsePicture::gpuBytes() const {
    return composite_.gpuBytes() + (onGpu_ ? onGpu_->gpuBytes() : 0);
}

}  // namespace dustbench::volume
