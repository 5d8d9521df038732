#include "bench/measure/image/volume_picture.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/image_check.h"

namespace dustbench::bench {

std::optional<double> volumePicture(const Plane& alpha, const Plane& volumeAlpha) {
    requireSameSize(alpha, "the method's layer", volumeAlpha, "its volume's layer");
    double differences = 0, squares = 0, volumeSquares = 0;
    for (std::size_t i = 0; i < alpha.values.size(); ++i) {
        const auto a = static_cast<double>(alpha.values[i]), b = static_cast<double>(volumeAlpha.values[i]);
        differences += (a - b) * (a - b);
        squares += a * a;
        volumeSquares += b * b;
    }
    const double larger = std::max(squares, volumeSquares);
    return larger > 0 ? std::optional(std::sqrt(differences / larger)) : std::nullopt;
}

}  // namespace dustbench::bench
