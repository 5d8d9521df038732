// Moment-based order-independent transparency: two passes add puffs up in any order. The first gives a few moments of
// the optical depth along each pixel's ray, the second weights each puff's colour with the transmittance that the
// moments give for its place.
//
// Source: Munstermann2018, 3. Departs: `profile=puff` takes a puff's own moments along the ray, cut by eye and scene in
// closed form, in place of those of a point, weights it with its depth in place of its alpha, and may average T over
// three places of it, and takes T halfway between its bounds in place of a quarter; distances are along the ray in
// place of the camera's axis, between the nearest and the farthest puff; moments and sums are single precision; α is
// that of the sum of depths.
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
    int moments = 6;  ///< besides the zeroth: 4 or 6
    Shape shape = Shape::puff;
    int samples = 1;  ///< places of a puff at which T is taken: 1 or 3
    Warp warp = Warp::log;
    double overestimation = 0.5;  ///< the paper's for points: 0.25
    double biasFactor = 1;        ///< of the paper's bias
    double reachDeviations = 3.5;
};

/// Distances from the eye between which the puffs before it lie, at least 1 % apart.
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
