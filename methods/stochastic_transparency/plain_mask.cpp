#include <cmath>

#include "methods/kit/maths/philox.h"
#include "methods/stochastic_transparency/stochastic_transparency.h"

namespace dustbench::stochastic_transparency {

std::uint64_t plainMask(const Settings& settings, std::uint64_t seed, std::uint32_t pixel, std::uint32_t puff,
                        float alpha) {
    const std::uint64_t serial = pixel | static_cast<std::uint64_t>(puff) << 32;
    const int samples = settings.samples;
    const float offset = maths::uniform4(seed, stream, serial)[0];
    int wanted = static_cast<int>(std::floor(alpha * static_cast<float>(samples) + offset));
    std::uint64_t mask = 0;
    for (int s = 0; s < samples; ++s) {
        const auto draw = static_cast<std::uint32_t>(1 + s / 4);
        const float uniform = maths::uniform4(seed, stream, serial, draw)[static_cast<std::size_t>(s % 4)];
        const bool covered = settings.stratified
                                 ? uniform * static_cast<float>(samples - s) < static_cast<float>(wanted)
                                 : uniform < alpha;
        if (!covered) continue;
        --wanted;
        mask |= std::uint64_t{1} << s;
    }
    return mask;
}

}  // namespace dustbench::stochastic_transparency
