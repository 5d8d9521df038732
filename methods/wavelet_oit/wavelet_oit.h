// Wavelet transparency: two passes add up puffs in any order. The first sums the coefficients of Haar wavelets of the
// optical depth along each pixel's ray, the second weights each puff's colour with the transmittance in front of it.
//
// Targets with additive blending take the sums. OpenGL 4.5 lacks atomics on floats, and blending adds in the order of
// the puffs, so that the picture is the same each time.
//
// Units: metres. Colours: linear RGB, premultiplied.
// Source: AizenshteinEtAl2022, by its abstract and by open-source shaders after Osorio2024; neither text was at hand.
// Departs: no refraction. A puff's own part is taken off once in closed form instead of from each coefficient.
// `puff=volume` uses the integral of a puff's extinction between eye and scene instead of a step. `packed` stores half
// floats. α follows from a sum of depths in single precision.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/colour_sums.h"
#include "methods/kit/draw/depth_mapping.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/wavelet_oit/plain_wavelets.h"

namespace dustbench::wavelet_oit {

/// `surface`: at the depth of the puff's centre, with the alpha of its whole chord. `volume`: its extinction along the
/// ray, cut at eye and scene.
enum class Puff { surface, volume };
inline constexpr Choices<Puff> puffKinds{{"surface", Puff::surface}, {"volume", Puff::volume}};

enum class Storage { singles, halves };
inline constexpr Choices<Storage> storages{{"float", Storage::singles}, {"packed", Storage::halves}};

inline constexpr Choices<Warp> warps{{"log", Warp::log}, {"linear", Warp::linear}};

/// Which puffs the mapping of distances spans: all of the frame, or those of a pixel, found by a pass of its own.
enum class Bounds { frame, pixel };
inline constexpr Choices<Bounds> boundKinds{{"frame", Bounds::frame}, {"pixel", Bounds::pixel}};

struct Settings {
    int rank = 3;
    Storage storage = Storage::singles;
    Puff puff = Puff::surface;
    Warp warp = Warp::log;
    Bounds bounds = Bounds::frame;
    double reachDeviations = 3.5;
};

/// Maps the puffs in front of the eye to 0..1 less a cell.
[[nodiscard]] MappedDepth depthRange(const Puffs& dust, const scene::View& view, const Settings& settings);

class WaveletOit final : public Method {
 public:
    explicit WaveletOit(const Settings& settings) : settings_(settings) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    /// Throws InputError if the bounds of a picture of this size do not fit in one buffer.
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

    /// The sums of the last picture, four in each target.
    [[nodiscard]] const draw::SumTargets& coefficients() const { return *coefficients_; }

 private:
    void findBounds(const Frame& frame, const gpu::Layer& layer);
    [[nodiscard]] gpu::Program& begin(draw::FragmentPass& pass, const Frame& frame, const gpu::Layer& layer);

    Settings settings_;
    gpu::Device* device_ = nullptr;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::SumTargets> coefficients_, colours_;
    std::optional<draw::AverageColour> average_;
    std::optional<draw::FragmentPass> boundsPass_, coefficientPass_, colourPass_;
    std::optional<draw::DepthMapping> mapping_;  ///< of the frame
    gpu::Buffer bounds_;                         ///< of pixels
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::wavelet_oit
