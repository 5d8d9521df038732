// Ground truth by ray marching, for clouds whose particles have individual colours or whose lighting varies.
//
// Emission and absorption along each pixel's ray, t from the eye:
//
//     L = ∫ T(t)·Σᵢ σᵢ(t)·cᵢ·J(t) dt,   T(t) = exp(−∫₀ᵗ Σᵢ σᵢ)
//
// The ray is divided into slabs. In each slab the depth Δτᵢ of every puff is the closed form, so α is exact. Only the
// colours are assumed to be evenly mixed over the slab, Σ cᵢ·Δτᵢ / Σ Δτᵢ, and J is taken at its middle. The error is of
// second order in the slab's length, and 0 for a single colour and uniform light. For the colours alone it is bounded:
// a slab of depth Δ, reached by transmittance T, contributes an error of at most T·Δ²/8 times the range of the colours.
// The sum of these is CloudImage::colourErrorBound (of first order, so far above the actual error). A slab that
// contributes less than 1e-9 of the light is skipped. With slabs of 0.1 m and random colours in puffs of 0.25 m and
// larger, the error of each channel is at most 2e-3.
//
// Units: metres. Colours: linear RGB, premultiplied. Threads: uses the current oneTBB arena; bit-identical at any
// number.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "bench/reference/particle_image.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"

namespace dustbench::reference {

/// Light of the lit variant. As in scene::dustColour, a white surface facing the sun has the value `sun`: single
/// scattering gives ϖ·F·sun/4 from the sun, attenuated on its way through the dust, with the phase function F of
/// scene::phaseFactor, and ϖ·ambient from the sky, which is not attenuated. Not included: multiple scattering, and
/// shadows of ground, solids and vehicle in the dust.
struct SunLight {
    /// As scene::dustLight, to be multiplied by the colours that the dust has without light.
    [[nodiscard]] static SunLight of(const scene::Scene& scene);

    glm::dvec3 toSun{0, 1, 0};  ///< towards the sun, world
    glm::dvec3 sun{1};
    glm::dvec3 ambient{0};
    double asymmetry = 0;  ///< of F; 0: F = 1
    /// ϖ of all puffs; empty: each puff's colour in the store is its ϖ.
    std::optional<glm::dvec3> albedo{};
};

/// J = 1: uses the store's colours directly. Called by renderParticles if colours differ; throws as it does.
[[nodiscard]] CloudImage marchParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                                        const ReferenceOptions& options = {});

/// J(t) = F·sun/4·exp(−Σ towards the sun) + ambient, single scattering; the depth towards the sun is again the closed
/// form. `options.slabMetres` controls the error; halving it divides the error by four if slabs are short relative to
/// the puffs (r/4 or less). With 0.1 m and puffs with radii of 0.5 m and larger, halving changes no channel of a lit
/// trail by more than 1e-3. The opacities are those of renderParticles, for any slab length.
/// Takes half a minute for 3,000 puffs at 640×480 on 2 cores.
/// Throws as renderParticles does, and std::invalid_argument for a zero sun direction.
[[nodiscard]] CloudImage renderLitParticles(const Puffs& store, const scene::View& view,
                                            const OpaqueDistances& distances, const SunLight& light,
                                            const ReferenceOptions& options = {});

}  // namespace dustbench::reference
