// Perceptual colour spaces: CIELAB from linear sRGB, and the linear opponent space in which FLIP blurs.
//
//     X, Y, Z = M · (R, G, B)       M from the primaries of sRGB and the white point D65
//     CIELAB:   L* = 116 f(Y/Yw) − 16,  a* = 500 (f(X/Xw) − f(Y/Yw)),  b* = 200 (f(Y/Yw) − f(Z/Zw))
//               f(t) = ∛t above (6/29)³, its tangent there below
//     YyCxCz:   the same with f(t) = t
//
// Units: linear sRGB in [0, 1]; L*, Yy from 0 (black) to 100 (white). Threads: pure. Source: Andersson2020, section 4.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::measure {

[[nodiscard]] glm::vec3 opponentFromLinear(glm::vec3 rgb);
[[nodiscard]] glm::vec3 linearFromOpponent(glm::vec3 yCxCz);
[[nodiscard]] glm::vec3 labFromLinear(glm::vec3 rgb);
[[nodiscard]] glm::vec3 linearFromLab(glm::vec3 lab);

}  // namespace dustbench::measure
