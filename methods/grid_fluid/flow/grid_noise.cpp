#include "methods/grid_fluid/flow/grid_noise.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr int leastCells = 10;

/// cos and sin of 2πn/N.
struct Turns {
    explicit Turns(std::size_t count) : cosines(count), sines(count) {
        for (std::size_t n = 0; n < count; ++n) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(count);
            cosines[n] = std::cos(angle);
            sines[n] = std::sin(angle);
        }
    }
    std::vector<double> cosines, sines;
};

struct Power {
    double high = 0, all = 0;
};

/// |Σ vⱼ·e^(−2πi·jf/N)|² for the frequencies above 0, of windowed values.
Power powerOf(const std::vector<double>& values, const Turns& turns) {
    const std::size_t count = values.size(), highest = count / 2;
    Power power;
    for (std::size_t f = 1; f <= highest; ++f) {
        double real = 0, imaginary = 0;
        for (std::size_t j = 0, turn = 0; j < count; ++j, turn = (turn + f) % count) {
            real += values[j] * turns.cosines[turn];
            imaginary += values[j] * turns.sines[turn];
        }
        // Each frequency counts twice, except that of ±1, ∓1.
        const double here = (real * real + imaginary * imaginary) * (2 * f == count ? 1 : 2);
        power.all += here;
        if (5 * f > 4 * highest) power.high += here;
    }
    return power;
}

}  // namespace

double gridNoise(std::span<const float> values, std::span<const std::uint8_t> solids, const glm::ivec3& cells) {
    if (cells.y < leastCells) return 0;
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y),
               nz = static_cast<std::size_t>(cells.z);
    const Turns turns(ny);
    std::vector<Power> ofSlab(nz);
    parallel::forEachBlock(nz, 1, [&](std::size_t k, std::size_t) {
        std::vector<double> column(ny);
        for (std::size_t i = 0; i < nx; ++i) {
            double sum = 0;
            bool isClear = true;
            for (std::size_t j = 0; j < ny; ++j) {
                const std::size_t at = (k * ny + j) * nx + i;
                column[j] = static_cast<double>(values[at]);
                sum += column[j];
                isClear = isClear && (solids.empty() || solids[at] == 0);
            }
            if (!isClear) continue;
            // Hann's window at the middle of each cell.
            for (std::size_t j = 0; j < ny; ++j)
                column[j] =
                    (column[j] - sum / static_cast<double>(ny)) * 0.5 *
                    (1 - std::cos(2 * std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(ny)));
            const Power power = powerOf(column, turns);
            ofSlab[k].high += power.high;
            ofSlab[k].all += power.all;
        }
    });
    Power sum;
    for (const Power& power : ofSlab) {
        sum.high += power.high;
        sum.all += power.all;
    }
    return sum.all > 0 ? sum.high / sum.all : 0;
}

}  // namespace dustbench::grid_fluid::flow
