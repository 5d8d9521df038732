// Weighted blended order-independent transparency: puffs are added up in any order, each with a weight that decreases
// with its distance. The mean of their colours is blended over the scene with the cloud's exact alpha.
//
// Source: McGuireBavoil2013, Eq. 6 to 10. Departs: a puff's alpha follows from its optical depth along the pixel's ray,
// limited by eye and scene in closed form. The cloud's alpha is 1 − exp(−Σ) instead of 1 − Π(1 − α), which is equal.
// Sums are single instead of half precision. The far plane of Eq. 10 is at infinity.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/average_colour.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/sum_targets.h"

namespace dustbench::weighted_oit {

enum class Weight { eq7, eq8, eq9, eq10, none };
inline constexpr Choices<Weight> weights{
    {"eq7", Weight::eq7}, {"eq8", Weight::eq8}, {"eq9", Weight::eq9}, {"eq10", Weight::eq10}, {"none", Weight::none}};

/// w(z, α): z in metres along the camera's axis, α the puff's alpha at the pixel.
/// Source: McGuireBavoil2013, Eq. 7 to 10; `none`: Eq. 5.
[[nodiscard]] double plainWeight(Weight weight, double axisMetres, double alpha, double nearMetres);

class WeightedOit final : public Method {
 public:
    WeightedOit(Weight weight, double reachDeviations) : weight_(weight), reach_(reachDeviations) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    Weight weight_;
    double reach_;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::SumTargets> sums_;
    std::optional<draw::AverageColour> average_;
    std::optional<draw::FragmentPass> pass_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::weighted_oit
