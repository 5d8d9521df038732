// Moment-based order-independent transparency: two passes add up puffs in any order. The first computes a few moments
// of the optical depth along each pixel's ray. The second weights each puff's colour with the transmittance estimated
// from the moments at its position.
//
// `puff=surface` is the method as published: a puff is a surface at its centre's depth. `mode=paper` selects it. With
// `puff=volume` a puff has its own moments along the ray, limited by eye and scene in closed form.
//
// Source: Munstermann2018, 3; MuellerEtAl2025 has analytic moments of Gaussians, independent of ours. Departs: sums are
// single precision. α follows from the sum of depths. 16-bit moments are added up in tiles of a compute shader, in the
// order of the puffs, instead of in rasteriser-ordered views; b₀ stays in 32 bits. `puff=volume` weights a puff with
// its depth instead of its alpha, may average T over three places in it, and takes T halfway between its bounds instead
// of at a quarter. Its distances are along the ray instead of the camera's axis, between the nearest and the farthest
// puff.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/colour_sums.h"
#include "methods/kit/draw/depth_mapping.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/tile_pass.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/moment_oit/plain_moments.h"

namespace dustbench::moment_oit {

inline constexpr Choices<Warp> warps{{"log", Warp::log}, {"linear", Warp::linear}};

inline constexpr Choices<Basis> bases{{"power", Basis::power}, {"trigonometric", Basis::trigonometric}};
inline constexpr Choices<Precision> precisions{{"float", Precision::single}, {"quantised", Precision::quantised}};

enum class Puff {
    surface,  ///< as published: a surface at its centre's depth, with the alpha of the whole puff along the ray
    volume,   ///< cut by eye and scene, extended along the ray
};
inline constexpr Choices<Puff> puffKinds{{"surface", Puff::surface}, {"volume", Puff::volume}};

enum class Shape { puff, point };  ///< of a volume
inline constexpr Choices<Shape> shapes{{"puff", Shape::puff}, {"point", Shape::point}};

struct Settings {
    Kind kind{};
    Puff puff = Puff::volume;
    Shape shape = Shape::puff;
    int samples = 1;  ///< number of places in a puff at which T is evaluated: 1 or 3
    Warp warp = Warp::log;
    double overestimation = 0.5;  ///< the paper uses 0.25, for surfaces
    double biasFactor = 1;        ///< factor on the paper's bias
    double reachDeviations = 3.5;
};

/// Range of distances that contains the puffs in front of the eye; its ends are at least 1 % apart. Volumes: distances
/// from the eye, of the puffs' nearest and farthest points. Surfaces: of their centres, along the camera's axis.
[[nodiscard]] WarpedDepth depthRange(const Puffs& dust, const scene::View& view, Warp warp, Puff puff);

class MomentOit final : public Method {
 public:
    explicit MomentOit(const Settings& settings) : settings_(settings) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    void addMoments(const Frame& frame, const gpu::Layer& layer);
    void addQuantisedMoments(const Frame& frame, const gpu::Layer& layer);
    /// b₀ in the first channel.
    [[nodiscard]] const gpu::Texture& total() const { return moments_->texture(isQuantised() ? 0 : 1); }
    [[nodiscard]] bool isQuantised() const { return settings_.kind.precision == Precision::quantised; }

    Settings settings_;
    gpu::Device* device_ = nullptr;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::DepthMapping> warp_;
    std::optional<draw::SumTargets> moments_, colours_;
    std::optional<draw::AverageColour> average_;
    std::optional<draw::FragmentPass> momentPass_, colourPass_;
    std::optional<draw::TilePass> quantisedPass_;
    gpu::Buffer quantisedMoments_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::moment_oit
