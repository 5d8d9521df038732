#include "methods/exact_tiles/exact_tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

#include "draw_shaders.h"
#include "exact_tiles_shaders.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::exact_tiles {
namespace {

/// Rounds up to eighths of the next power of two: grows rarely, and does not depend on the previous size.
std::size_t capacityFor(std::size_t bytes) {
    const std::size_t step = std::max<std::size_t>(std::bit_ceil(bytes) / 8, 64);
    return (bytes + step - 1) / step * step;
}

template <typename T>
void upload(gpu::Device& device, std::string_view label, std::span<const T> values, gpu::Buffer& buffer) {
    if (values.empty()) return;
    if (buffer.bytes() < values.size_bytes()) buffer = gpu::Buffer(device, label, capacityFor(values.size_bytes()));
    std::memcpy(buffer.mapForWriting(values.size_bytes()), values.data(), values.size_bytes());
    buffer.unmap();
}

}  // namespace

void ExactTiles::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    loops_.emplace(device);
}

void ExactTiles::update(const Frame& frame) {
    {
        const auto timing = frame.clock.measure(Stage::sort);
        tiles_.build(frame.dust, frame.view, settings_.toleratedDepth,
                     frame.dust.uniformColour ? Along::back : Along::front);
    }
    const auto timing = frame.clock.measure(Stage::upload);
    if (listedFor_ && (listedFor_->width != frame.view.width || listedFor_->height != frame.view.height)) {
        lists_ = {};
        entries_ = {};
    }
    upload(*device_, "puffs", tiles_.puffs(), puffs_);
    upload(*device_, "lists of tiles", tiles_.lists(), lists_);
    upload(*device_, "entries of tiles", tiles_.entries(), entries_);
    listedFor_ = frame.view;
}

bool ExactTiles::isListedFor(const scene::View& view) const {
    return listedFor_ && listedFor_->width == view.width && listedFor_->height == view.height &&
           listedFor_->camera.eye == view.camera.eye && listedFor_->camera.target == view.camera.target &&
           listedFor_->camera.up == view.camera.up &&
           listedFor_->camera.verticalFieldOfView == view.camera.verticalFieldOfView;
}

gpu::Program& ExactTiles::program(bool oneColour) {
    std::optional<gpu::Program>& made = oneColour ? sum_ : march_;
    // A software renderer's lanes read memory one by one, so several rows share a read. A GPU needs many invocations.
    const int rows = settings_.rowsAtOnce > 0 ? settings_.rowsAtOnce : device_->isSoftware() ? tilePixels : 1;
    const std::map<std::string, std::string> definitions{{"ROWS", std::to_string(rows)}};
    if (!made)
        made.emplace(
            *device_, oneColour ? "exact tiles: sum" : "exact tiles: march",
            std::initializer_list<gpu::ShaderFile>{
                draw_shaders::error_function_glsl, draw_shaders::loop_limit_glsl, exact_tiles_shaders::tile_puffs_glsl,
                oneColour ? exact_tiles_shaders::tile_sum_comp : exact_tiles_shaders::tile_march_comp},
            definitions);
    return *made;
}

void ExactTiles::draw(const Frame& frame, gpu::Layer& layer) {
    // A viewer may turn the camera without an update.
    if (!isListedFor(frame.view)) update(frame);
    if (tiles_.puffs().empty()) return;
    const double pixelSlope = 2 * std::tan(frame.view.camera.verticalFieldOfView / 2) / frame.view.height;
    gpu::Program& program = this->program(frame.dust.uniformColour);
    program.set("projection", glm::vec3(pixelSlope, pixelSlope, frame.view.camera.nearMetres));
    if (frame.dust.uniformColour)
        program.set("colourOfAll", frame.dust.colourOfAll);
    else
        program.set("slabDeviations", static_cast<float>(settings_.slabDeviations));
    puffs_.bindStorage(0);
    lists_.bindStorage(1);
    entries_.bindStorage(2);
    layer.sceneDepth().bind(0);
    layer.colour().bindImage(0, false, true);
    loops_->bind(program);
    program.dispatch(tiles_.columns(), tiles_.rows(), 1);
}

void ExactTiles::report(const Frame&, Facts&) const {
    if (loops_) loops_->requireWholeLoops("exact_tiles");
}

MemoryReport ExactTiles::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : ledger_.entries()) report.push_back({structure, bytes, 0});
    report.push_back({"puffs", 0, puffs_.bytes()});
    report.push_back({"tiles", 0, lists_.bytes() + entries_.bytes()});
    return report;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Exact tiles";
    info.summary =
        "The ground truth on the GPU: a compute shader sums the closed-form optical depths of each tile's puffs.";
    info.source = "Olsson2011";
    info.takesLights = true;
    info.parameters
        .real("tolerated_depth", 1e-6, 1e-9, 0.01, "",
              "optical depth per pixel that may be neglected beyond the edges of puffs; larger is faster")
        .real("slab", 0.5, 0.05, 4, "deviations",
              "step length through dust of several colours, in standard deviations of the narrowest puff of a tile; "
              "the error grows with its square");
    info.create = [](const ParameterValues& values) {
        return std::make_unique<ExactTiles>(
            Settings{.toleratedDepth = values.real("tolerated_depth"), .slabDeviations = values.real("slab")});
    };
    return info;
}

}  // namespace dustbench::exact_tiles
