// Noise that a puff carries along: it makes the puff's optical depth uneven, differently for each puff, and moves and
// grows with it.
//
//     τ(p) ← τ(p)·(1 + a·g(N(q))),   q = (p − c)/(k·r) + o(serial)
//
// N: three octaves of gradient noise; g cuts 2.2·N off at ±1; c and r: the puff's centre and radius; o: a random
// offset. N and −N are equally probable and g is odd, so that the mean of τ over puffs is kept.
//
// Units: m. Frame: world. Threads: pure. Source: Perlin2002; Carr2006, 5 (future work: dynamically generated noise).
// Departs: gradients along the twelve edges only, by an integer hash, so that CPU and GPU agree.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/parameters.h"

namespace dustbench::draw {

struct NoiseSettings {
    float amplitude = 0;     ///< a: largest relative change of the optical depth, 0..1; 0: no noise
    float cellRadii = 0.6f;  ///< k: edge of a cell of the lowest octave, in radii of the puff

    [[nodiscard]] bool isOn() const { return amplitude > 0; }
};

/// Declares `noise` and `noise_scale`.
DUSTBENCH_API void declareNoise(ParameterSet& parameters);
[[nodiscard]] DUSTBENCH_API NoiseSettings noiseSettings(const ParameterValues& values);

/// The noise of one shape: q at its centre, and the length of a step of 1 in q.
struct NoisePlace {
    glm::vec3 place;
    float metres;
};
/// `fromCentre`: of the shape's centre, from that of the particle that carries the noise.
[[nodiscard]] DUSTBENCH_API NoisePlace noiseOf(std::uint64_t serial, float radiusMetres, const glm::vec3& fromCentre,
                                               const NoiseSettings& settings);

/// g(N(q)), −1..1: the reference of gradient_noise.glsl.
[[nodiscard]] DUSTBENCH_API float plainNoise(const glm::vec3& q);

}  // namespace dustbench::draw
