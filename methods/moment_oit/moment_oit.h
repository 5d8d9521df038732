// Moment-based order-independent transparency: two passes add up puffs in any order. The first computes a few moments
// of the optical depth along each pixel's ray. The second weights each puff's colour with the transmittance estimated
// from the moments at its position.
//
// Source: Munstermann2018, 3. Departs: `profile=puff` uses a puff's own moments along the ray, limited by eye and scene
// in closed form, instead of those of a point. It weights a puff with its depth instead of its alpha, may average T
// over three places in it, and takes T halfway between its bounds instead of at a quarter. Distances are along the ray
// instead of the camera's axis, between the nearest and the farthest puff. Moments and sums are single precision. α
// follows from the sum of depths.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/average_colour.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/sum_targets.h"
#include "methods/moment_oit/plain_moments.h"

namespace dustbench::moment_oit {

inline constexpr Choices<Warp> warps{{"log", Warp::log}, {"linear", Warp::linear}};

enum class Shape { puff, point };
inline constexpr Choices<Shape> shapes{{"puff", Shape::puff}, {"point", Shape::point}};

struct Settings {
    int moments = 6;  ///< 4 or 6, in addition to the zeroth
    Shape shape = Shape::puff;
    int samples = 1;  ///< number of places in a puff at which T is evaluated: 1 or 3
    Warp warp = Warp::log;
    double overestimation = 0.5;  ///< the paper uses 0.25, for points
    double biasFactor = 1;        ///< factor on the paper's bias
    double reachDeviations = 3.5;
};

/// Range of distances from the eye that contains the puffs in front of it; its ends are at least 1 % apart.
[[nodiscard]] WarpedDepth depthRange(const Puffs& dust, const scene::View& view, Warp warp);

class MomentOit final : public Method {
 public:
    explicit MomentOit(const Settings& settings) : settings_(settings) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    Settings settings_;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::SumTargets> moments_, colours_;
    std::optional<draw::AverageColour> average_;
    std::optional<draw::FragmentPass> momentPass_, colourPass_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::moment_oit
