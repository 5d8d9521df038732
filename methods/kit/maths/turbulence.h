// A cheap, divergence-free gust field: four plane waves, each with velocity transverse to its wave vector.
//
//     u(x, t) = Σ aⱼ·eⱼ·w(kⱼ·x − fⱼ·t + φⱼ),   eⱼ ⊥ kⱼ   ⇒   ∇·u = 0 for any waveform w
//
// Wavelengths lⱼ = L·0.729ʲ; speeds scale as l^⅓ and periods as l^⅔, as for eddies of one energy cascade. The k lie
// along the diagonals of a cube and the e in its faces, so that a wave costs a dozen operations.
// Units: m, s, m/s, turns. Threads: pure.
// Source: Kraichnan1970, Eq. 7 (random Fourier modes). Departs: four fixed directions instead of many random ones;
// parabolas instead of sines.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::maths {

/// w: 16·r·(½ − |r|) with r = turns − ⌊turns⌉, smooth, odd, within 0.06 of sin(2π·turns). Its mean square is 8/15.
[[nodiscard]] inline float parabolicWave(float turns) {
    const float r = turns - roundToInteger(turns);
    return 16.0f * (r * (0.5f - std::fabs(r)));
}

/// The field at one moment.
struct GustField {
    static constexpr std::size_t waves = 4;

    std::array<float, waves> turnsPerMetre{};  ///< along each axis: |k|/√3
    std::array<float, waves> phaseTurns{};     ///< φ − f·t, in [0, 1)
    std::array<float, waves> amplitude{};      ///< along each of the two axes that e lies between, m/s

    [[nodiscard]] glm::vec3 operator()(float x, float y, float z) const {
        const float sum = y + z, difference = y - z;
        const float w0 = wave(0, x + sum), w1 = wave(1, x - sum), w2 = wave(2, x - difference),
                    w3 = wave(3, x + difference);
        // k ∝ (1,1,1), (1,−1,−1), (1,−1,1), (1,1,−1);  e ∝ (1,0,−1), (0,1,−1), (1,1,0), (1,0,1)
        return {(w0 + w2) + w3, w1 + w2, (w3 - w0) - w1};
    }

 private:
    [[nodiscard]] float wave(std::size_t j, float along) const {
        return amplitude[j] * parabolicWave(turnsPerMetre[j] * along + phaseTurns[j]);
    }
};

/// The field at `timeSeconds`, advected by `drift` (m/s). `rmsSpeed`: √⟨|u|²⟩ over space.
[[nodiscard]] inline GustField gustField(double rmsSpeed, double longestMetres, double longestSeconds,
                                         const glm::dvec3& drift, double timeSeconds, std::uint64_t seed,
                                         std::uint32_t stream) {
    const std::array<glm::dvec3, GustField::waves> diagonals{{{1, 1, 1}, {1, -1, -1}, {1, -1, 1}, {1, 1, -1}}};
    GustField field;
    double length = 1, speed = 1, period = 1, squares = 0;  // of wave j, relative to the longest wave's
    for (std::size_t j = 0; j < GustField::waves; ++j) {
        const double k = 1 / (std::sqrt(3.0) * longestMetres * length);
        const double phase = static_cast<double>(unitFloat(randomWords(seed, stream, j)[0])) -
                             timeSeconds * (1 / (longestSeconds * period) + k * glm::dot(diagonals[j], drift));
        field.turnsPerMetre[j] = static_cast<float>(k);
        field.phaseTurns[j] = static_cast<float>(phase - std::floor(phase));
        field.amplitude[j] = static_cast<float>(speed);
        squares += speed * speed * 2 * 8 / 15;  // two axes, ⟨w²⟩ = 8/15
        length *= 0.729;
        speed *= 0.9;
        period *= 0.81;
    }
    const float scale = static_cast<float>(rmsSpeed / std::sqrt(squares));
    for (float& amplitude : field.amplitude) amplitude *= scale;
    return field;
}

}  // namespace dustbench::maths
