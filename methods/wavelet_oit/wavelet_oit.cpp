#include "methods/wavelet_oit/wavelet_oit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/draw/cost_facts.h"
#include "methods/kit/maths/transmittance.h"
#include "wavelet_oit_shaders.h"

namespace dustbench::wavelet_oit {
namespace {

constexpr double volumeDeviations = 3;  ///< from a puff's centre, of rays that the range of distances takes in
constexpr int bitsOfSums = 4 * 32 + 32, bitsOfBounds = 2 * 32;

int coefficientsOfRank(int rank) {
    return 2 << rank;
}

std::map<std::string, std::string> definitionsOf(const Settings& settings, const char* boundsAccess) {
    std::map<std::string, std::string> names{{"RANK", std::to_string(settings.rank)}};
    if (settings.puff == Puff::volume) names["VOLUME"] = "";
    if (settings.warp == Warp::log) names["WARP_LOG"] = "";
    if (settings.bounds == Bounds::pixel) names.insert({{"PIXEL_BOUNDS", ""}, {"BOUNDS_ACCESS", boundsAccess}});
    return names;
}

/// Offset and factor of the shaders' mapping.
glm::vec2 mappingUniform(const MappedDepth& depth) {
    const bool log = depth.warp == Warp::log;
    const double from = log ? std::log(depth.nearestMetres) : depth.nearestMetres;
    const double to = log ? std::log(depth.farthestMetres) : depth.farthestMetres;
    return {from, depth.last / (to - from)};
}

}  // namespace

MappedDepth depthRange(const Puffs& dust, const scene::View& view, const Settings& settings) {
    const glm::dvec3 eye = view.camera.eye, ahead = glm::normalize(view.camera.target - eye);
    const bool isSurface = settings.puff == Puff::surface;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const glm::dvec3 centre = glm::dvec3(dust.position(i)) - eye;
        const double axis = glm::dot(centre, ahead), distance = glm::length(centre);
        const double reach = volumeDeviations * maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        if (axis < (isSurface ? view.camera.nearMetres : -reach)) continue;
        // On a ray that passes the centre at `reach`, the nearest point has the least distance.
        const double least = std::sqrt(std::max(distance * distance - reach * reach, 0.0));
        nearest = std::min(nearest, isSurface ? axis : least);
        farthest = std::max(farthest, isSurface ? axis : distance);
    }
    nearest = std::max(nearest < farthest ? nearest : farthest, view.camera.nearMetres);
    return {settings.warp, nearest, std::max(farthest, 1.001 * nearest), 1 - 1.0 / coefficientsOfRank(settings.rank)};
}

void WaveletOit::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    namespace shaders = wavelet_oit_shaders;
    device_ = &device;
    quads_.emplace(device, settings_.reachDeviations);
    const auto format = settings_.storage == Storage::halves ? gpu::Format::rgba16F : gpu::Format::rgba32F;
    const auto targets = static_cast<std::size_t>(coefficientsOfRank(settings_.rank) / 4);
    coefficients_.emplace(device, "coefficients", std::vector<gpu::Format>(targets, format));
    colours_.emplace(device, "weighted colours", std::vector<gpu::Format>{gpu::Format::rgba32F, gpu::Format::r32F});
    average_.emplace(device);
    const auto reading = definitionsOf(settings_, "readonly");
    mapping_.emplace(device, shaders::depth_extent_glsl, reading);
    if (settings_.bounds == Bounds::pixel)
        boundsPass_ = draw::puffPass("depth bounds", {shaders::wavelets_glsl, shaders::depth_bounds_frag},
                                     definitionsOf(settings_, "coherent"));
    coefficientPass_ = draw::puffPass("coefficients", {shaders::wavelets_glsl, shaders::coefficient_sum_frag}, reading);
    colourPass_ =
        draw::puffPass("colours by wavelets", {shaders::wavelets_glsl, shaders::weighted_colour_frag}, reading);
}

void WaveletOit::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

gpu::Program& WaveletOit::begin(draw::FragmentPass& pass, const Frame& frame, const gpu::Layer& layer) {
    gpu::Program& program = quads_->begin(pass, frame.view);
    if (settings_.bounds == Bounds::pixel) program.set("pictureWidth", layer.width());
    return program;
}

void WaveletOit::findBounds(const Frame& frame, const gpu::Layer& layer) {
    const std::size_t bytes =
        bitsOfBounds / 8 * static_cast<std::size_t>(layer.width()) * static_cast<std::size_t>(layer.height());
    if (bytes > device_->maximumStorageBytes())
        throw InputError("bounds: got pixel for " + std::to_string(layer.width()) + "x" +
                         std::to_string(layer.height()) + " pixels, allowed: up to " +
                         std::to_string(device_->maximumStorageBytes() * 8 / bitsOfBounds) + " pixels on this device");
    if (bounds_.bytes() != bytes) bounds_ = gpu::Buffer(*device_, "depth bounds", bytes);
    bounds_.clear();
    bounds_.bindStorage(1);
    layer.bindColourOnly();  // the pass discards its fragments
    quads_->store(begin(*boundsPass_, frame, layer), layer.sceneDepth());
}

void WaveletOit::draw(const Frame& frame, gpu::Layer& layer) {
    if (quads_->count() == 0) return;
    if (settings_.bounds == Bounds::pixel)
        findBounds(frame, layer);
    else if (frame.gpuDust)
        mapping_->useRangeOf(*frame.gpuDust, frame.view);
    else
        mapping_->use(mappingUniform(depthRange(frame.dust, frame.view, settings_)));

    gpu::Program& first = begin(*coefficientPass_, frame, layer);
    coefficients_->begin(layer.width(), layer.height());
    quads_->add(first, layer.sceneDepth());

    gpu::Program& second = begin(*colourPass_, frame, layer);
    if (!quads_->isColoured()) second.set("puffColour", frame.dust.colourOfAll);
    colours_->begin(layer.width(), layer.height());
    for (int target = 0; target < coefficientsOfRank(settings_.rank) / 4; ++target)
        coefficients_->texture(static_cast<std::size_t>(target)).bind(static_cast<std::uint32_t>(1 + target));
    quads_->add(second, layer.sceneDepth());
    average_->draw(colours_->texture(0), colours_->texture(1), layer);
}

void WaveletOit::report(const Frame&, Facts& facts) const {
    const int each = settings_.storage == Storage::halves ? 16 : 32;
    const int bounds = settings_.bounds == Bounds::pixel ? bitsOfBounds : 0;
    const int coefficients = each * coefficientsOfRank(settings_.rank);
    facts.set("bits_per_pixel", std::int64_t{coefficients + bitsOfSums + bounds});
    // Coefficients are added to and read, sums added to; bounds are widened and read twice.
    facts.set("bytes_per_fragment", std::int64_t{(3 * coefficients + 2 * bitsOfSums + 4 * bounds) / 8});
}

MemoryReport WaveletOit::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    if (coefficients_) report.push_back({"coefficients", 0, coefficients_->gpuBytes()});
    if (colours_) report.push_back({"weighted colours", 0, colours_->gpuBytes()});
    if (settings_.bounds == Bounds::pixel) report.push_back({"depth bounds", 0, bounds_.bytes()});
    return report;
}

std::int64_t WaveletOit::primitives() const {
    const int passes = settings_.bounds == Bounds::pixel ? 3 : 2;
    return quads_ ? passes * quads_->primitives() : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Wavelet transparency";
    info.summary =
        "Adds up puffs in any order in two passes: Haar wavelets of the optical depth along each ray, then colours "
        "weighted by transmittance.";
    info.source = "AizenshteinEtAl2022";
    info.takesLights = true;
    info.parameters.integer("rank", 3, 2, 4, "", "finest level of the wavelets; a pixel has 2^(rank + 1) coefficients")
        .choice("coefficients", Storage::singles, storages,
                "storage of a coefficient: a float, or a half float in half the memory")
        .choice("puff", Puff::surface, puffKinds,
                "a puff as a surface at its centre's depth, or as a volume along the ray, cut by eye and scene")
        .choice("warp", Warp::log, warps, "mapping of distances before the wavelets: by the logarithm, or none")
        .choice("bounds", Bounds::frame, boundKinds,
                "puffs that the mapping of distances spans: all of the frame, or those of each pixel, found by a pass "
                "of its own")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.facts = {draw::bitsPerPixel(), draw::bytesPerFragment()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<WaveletOit>(Settings{.rank = static_cast<int>(values.integer("rank")),
                                                     .storage = values.choice("coefficients", storages),
                                                     .puff = values.choice("puff", puffKinds),
                                                     .warp = values.choice("warp", warps),
                                                     .bounds = values.choice("bounds", boundKinds),
                                                     .reachDeviations = values.real("reach")});
    };
    return info;
}

}  // namespace dustbench::wavelet_oit
