// Sine and cosine of an angle in turns, by arithmetic only: vectorises, and gives the same bits in every build.
//
// Units: turns (1 = 2π). Range: |turns| < 2²¹; absolute error below 5e-7 there, for the argument as given.
// Threads: pure.
#pragma once

#include <cmath>

namespace dustbench::maths {

/// Rounds to the nearest integer, ties to even, for |v| < 2²²: adding 1.5·2²³ leaves no fractional bits.
[[nodiscard]] inline float roundToInteger(float v) {
    constexpr float shift = 0x1.8p23f;
    return (v + shift) - shift;
}

/// sin(2πf) for f in [−¼, ¼]: the odd minimax polynomial of degree 9 (Lawson's iteration), error 4e-9.
[[nodiscard]] inline float sineOfQuarter(float f) {
    const float f2 = f * f;
    return f * (6.28318501f + f2 * (-41.34165573f + f2 * (81.60100555f + f2 * (-76.54977417f + f2 * 39.53666306f))));
}

/// sin(2π·turns): removes whole turns, r in [−½, ½]; then sin(2πr) = sin(2π·(±½ − r)) folds r into [−¼, ¼].
[[nodiscard]] inline float sineOfTurns(float turns) {
    const float r = turns - roundToInteger(turns);
    const float rising = std::fabs(r), falling = 0.5f - rising;
    return sineOfQuarter(std::copysign(rising < falling ? rising : falling, r));
}

/// cos(2πr) = sin(2π·(¼ − |r|)).
[[nodiscard]] inline float cosineOfTurns(float turns) {
    return sineOfQuarter(0.25f - std::fabs(turns - roundToInteger(turns)));
}

}  // namespace dustbench::maths
