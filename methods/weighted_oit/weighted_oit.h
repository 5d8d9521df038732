// Weighted blended order-independent transparency: puffs are added up in any order, each with a weight that decreases
// with its distance. The mean of their colours is blended over the scene with the cloud's alpha.
//
// With the defaults, a puff's alpha follows from its optical depth along the pixel's ray, limited by eye and scene in
// closed form, sums are in single precision, and the cloud's alpha is 1 − exp(−Σ) instead of 1 − Π(1 − α), which is
// equal. `mode=paper` blends as published: surfaces, half-precision sums, and the product in 8 bits. `raster=tiles`
// draws the same layer without the GPU's rasteriser.
//
// Source: McGuireBavoil2013, Eq. 6 to 10. Departs: the far plane of Eq. 10 is at infinity; sums that overflow half
// precision end at its largest number.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "methods/contract/method.h"
#include "methods/kit/draw/colour_sums.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/draw/tile_puffs.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::weighted_oit {

enum class Weight { eq7, eq8, eq9, eq10, none };
inline constexpr Choices<Weight> weights{
    {"eq7", Weight::eq7}, {"eq8", Weight::eq8}, {"eq9", Weight::eq9}, {"eq10", Weight::eq10}, {"none", Weight::none}};

/// Storage of Σ α·w·c and Σ α·w.
enum class Accumulation { rgba32f, rgba16f };
inline constexpr Choices<Accumulation> accumulations{{"rgba32f", Accumulation::rgba32f},
                                                     {"rgba16f", Accumulation::rgba16f}};

/// What the cloud's alpha follows from: the sum of optical depths (r32f), or the product of 1 − α, as published.
enum class Revealage { r32f, r16f, r8 };
inline constexpr Choices<Revealage> revealages{
    {"r32f", Revealage::r32f}, {"r16f", Revealage::r16f}, {"r8", Revealage::r8}};

/// `volume`: cut by eye and scene, at the point of the ray nearest to its centre. `surface`: at the depth of its
/// centre, with the alpha of its whole chord.
enum class Puff { volume, surface };
inline constexpr Choices<Puff> puffs{{"volume", Puff::volume}, {"surface", Puff::surface}};

/// What adds the puffs up.
enum class Raster {
    hardware,  ///< the GPU's rasteriser and blending units
    tiles,     ///< a compute shader, tile by tile
};
inline constexpr Choices<Raster> rasters{{"hardware", Raster::hardware}, {"tiles", Raster::tiles}};

struct Settings {
    Weight weight = Weight::eq7;
    Accumulation accumulation = Accumulation::rgba32f;
    Revealage revealage = Revealage::r32f;
    Puff puff = Puff::volume;
    double reachDeviations = 3.5;
    Raster raster = Raster::hardware;
};

inline constexpr double largestHalf = 65504;
inline constexpr double leastDivisor = 1e-5;  ///< of half-precision sums

/// w(z, α): z in metres along the camera's axis, α the puff's alpha at the pixel.
/// Source: McGuireBavoil2013, Eq. 7 to 10; `none`: Eq. 5.
[[nodiscard]] double plainWeight(Weight weight, double axisMetres, double alpha, double nearMetres);

/// A puff at a pixel.
struct Fragment {
    double axisMetres, opticalDepth;
    glm::dvec3 colour;
};
/// The pixel's premultiplied colour and alpha. Each target is rounded to the nearest number of its format after every
/// fragment. The shaders' oracle.
[[nodiscard]] glm::dvec4 plainPixel(const Settings& settings, std::span<const Fragment> fragments, double nearMetres);

class WeightedOit final : public Method {
 public:
    /// Throws InputError for sums in other formats than single precision with `raster=tiles`.
    explicit WeightedOit(const Settings& settings);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    Settings settings_;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::TilePuffs> tiles_;  ///< if `raster` is tiles; then the next three are empty
    std::optional<draw::SumTargets> sums_;
    std::optional<draw::FragmentPass> pass_;
    std::optional<gpu::Program> mean_;
    gpu::VertexArray noVertices_;
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::weighted_oit
