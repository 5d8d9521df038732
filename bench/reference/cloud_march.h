// Ground truth where one colour does not do: colours of their own for the particles, or light that varies in the cloud.
//
// Emission and absorption along each pixel's ray, t from the eye:
//
//     L = ∫ T(t)·Σᵢ σᵢ(t)·cᵢ·J(t) dt,   T(t) = exp(−∫₀ᵗ Σᵢ σᵢ)
//
// The ray is cut into slabs. In each slab the depth Δτᵢ of every puff is the closed form, so that α is exact; taken as
// mixed evenly over it are only the colours, Σ cᵢ·Δτᵢ / Σ Δτᵢ, and J is that of its middle. The error is of second
// order in the slab's length, and 0 for one colour and even light. For the colours alone it is bounded: a slab of depth
// Δ, reached by T, is off by no more than T·Δ²/8 times the range of the colours, and the sum of these is
// CloudImage::colourErrorBound (of first order, so far above the error itself).
// A slab that gives less than 1e-9 of the light is left dark. With slabs of 0.1 m and random colours in puffs of 0.25 m
// and more, no channel is off by more than 2e-3.
//
// Units: metres. Colours: linear RGB, premultiplied. Threads: uses the current oneTBB arena; same bits at any number.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "bench/reference/particle_image.h"
#include "methods/contract/volume.h"

namespace dustbench::bench {

/// The light of the lit variant. As in scene::dustColour, a white surface that faces the sun reads `sun`, and light is
/// scattered to all sides alike (phase 1/4π): one scattering shows ϖ·sun/4 of the sun, dimmed on its way through the
/// dust, and ϖ·ambient of the sky, which is not dimmed. Not in it: light scattered twice or more, the shadows of
/// ground, solids and vehicle in the dust, and the dust's shadow on them.
struct SunLight {
    glm::dvec3 toSun{0, 1, 0};  ///< towards the sun, world
    glm::dvec3 sun{1};
    glm::dvec3 ambient{0};
    /// ϖ of all puffs; empty: each puff's colour in the store is its ϖ.
    std::optional<glm::dvec3> albedo{};
};

/// J = 1: the store's colours as they are. What renderParticles calls where colours differ; throws as it does.
[[nodiscard]] CloudImage marchParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                                        const ReferenceOptions& options = {});

/// J(t) = sun/4·exp(−Σ towards the sun) + ambient, single scattering; the depth towards the sun is the closed form
/// again. `options.slabMetres` sets the error; halving it quarters the error where slabs are short against the puffs
/// (r/4 or less). With 0.1 m and puffs of 0.5 m radius and more, halving changes no channel of a lit trail by more than
/// 1e-3. The opacities are those of renderParticles, whatever the slabs.
/// Takes half a minute for 3,000 puffs at 640×480 on 2 cores.
/// Throws as renderParticles does, and std::invalid_argument for a sun without direction.
[[nodiscard]] CloudImage renderLitParticles(const Puffs& store, const scene::View& view,
                                            const OpaqueDistances& distances, const SunLight& light,
                                            const ReferenceOptions& options = {});

}  // namespace dustbench::bench
