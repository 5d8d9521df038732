// Stochastic transparency: each puff covers a random share α of a pixel's samples, and each sample keeps the nearest
// surface. A second pass adds up the puffs in any order, each weighted by the share of samples in which it is seen.
//
// Source: EndertonEtAl2010, section 3: stratified masks, alpha correction, the depth-based variant. Departs:
// samples are in a buffer with atomic maxima instead of a multisampled target, so that 1 to 64 samples are possible
// and every driver draws the same masks. 1 − Π(1 − α) is 1 − exp(−Σ τ), which is equal. Sums are in single precision.
// Without alpha correction the mean over seeds is exact; with it the alpha is exact, and so is dust of one colour.
#pragma once

#include <cstdint>
#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/colour_sums.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/gpu/buffer.h"

namespace dustbench::stochastic_transparency {

/// `surface`: at the depth of the puff's centre, with the alpha of its whole chord. `volume`: its extinction is cut at
/// eye and scene, and it lies at the point of the ray nearest to its centre.
enum class Puff { surface, volume };
inline constexpr Choices<Puff> puffs{{"surface", Puff::surface}, {"volume", Puff::volume}};

struct Settings {
    int samples = 8;
    bool stratified = true;
    bool alphaCorrection = true;
    Puff puff = Puff::surface;
    double reachDeviations = 3.5;
};

inline constexpr std::uint32_t stream = 57;  ///< of the random numbers

/// The samples that a puff covers at a pixel (counted from the lower left), a bit each. The shader's oracle.
/// Source: EndertonEtAl2010, section 3.1.
[[nodiscard]] std::uint64_t plainMask(const Settings& settings, std::uint64_t seed, std::uint32_t pixel,
                                      std::uint32_t puff, float alpha);

class StochasticTransparency final : public Method {
 public:
    explicit StochasticTransparency(const Settings& settings) : settings_(settings) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    /// Throws InputError if the samples of a picture of this size do not fit in one buffer.
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    void fitSamples(int width, int height);

    Settings settings_;
    std::uint64_t seed_ = 1;
    gpu::Device* device_ = nullptr;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::SumTargets> sums_;
    std::optional<draw::AverageColour> average_;
    std::optional<draw::FragmentPass> depths_;
    std::optional<draw::FragmentPass> colours_;
    gpu::Buffer samples_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::stochastic_transparency
