#include "bench/reference/depth_sum.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::reference {
namespace {

using maths::HalfErrorFunction, maths::powerOfTwo;

constexpr int rowsAtOnce = 4;
/// Pixels of a row that are culled against a puff together; the loops run over whole groups.
constexpr int group = 8;
/// Smallest exponent of 2: below every depth that matters, and still within the range of our 2^x.
constexpr double minimumExponent = -1000;

/// One row of the image as columns of numbers, padded to whole groups.
struct Row {
    explicit Row(std::size_t padded)
        : inverseSquare(padded),
          inverse(padded),
          scene(padded),
          sums(padded),
          nearest(padded / group),
          farthest(padded / group) {}

    void begin(double slope, const std::vector<double>& slopesX, const double* metres, std::size_t width) {
        slopeY = slope;
        for (std::size_t i = 0; i < slopesX.size(); ++i) {
            inverseSquare[i] = 1 / (1 + slopesX[i] * slopesX[i] + slope * slope);
            inverse[i] = std::sqrt(inverseSquare[i]);
        }
        std::copy_n(metres, width, scene.begin());
        std::fill(scene.begin() + static_cast<std::ptrdiff_t>(width), scene.end(), metres[width - 1]);
        std::ranges::fill(sums, 0.0);
        for (std::size_t g = 0; g < nearest.size(); ++g) {
            const auto [low, high] = std::minmax_element(&scene[g * group], &scene[g * group] + group);
            nearest[g] = *low;
            farthest[g] = *high;
        }
    }

    const HalfErrorFunction& halfErf = HalfErrorFunction::instance();
    double slopeY = 0;
    std::vector<double> inverseSquare, inverse;  ///< 1/D and 1/√D
    std::vector<double> scene;                   ///< t1
    std::vector<double> sums;
    std::vector<double> nearest, farthest;  ///< t1 of each group
};

/// Coefficients of one puff in one row: exponent = logDepth − (γ·(X − X0)² + κ)/D, to base 2.
struct DepthPuff {
    double logDepth, gamma, x0, kappa;
    double footAtZero, footPerSlope, inverseWidth;  ///< 1/(√2·s)
};

void addWhole(const DepthPuff& puff, const double* slopesX, Row& row, std::size_t first) {
    double* const sums = row.sums.data();
    const double* const inverseSquare = row.inverseSquare.data();
#pragma GCC ivdep
    for (std::size_t i = first; i < first + group; ++i) {
        const double u = slopesX[i] - puff.x0;
        const double exponent = puff.logDepth - (puff.gamma * u * u + puff.kappa) * inverseSquare[i];
        sums[i] += powerOfTwo(exponent > minimumExponent ? exponent : minimumExponent);
    }
}

/// ½[erf((t1 − tc)/√2s) − erf((0 − tc)/√2s)] of each pixel; far from the eye the second term is −1.
template <bool cutByEye>
void addCut(const DepthPuff& puff, const double* slopesX, Row& row, std::size_t first) {
    const HalfErrorFunction& halfErf = row.halfErf;
    double* const sums = row.sums.data();
    const double* const inverseSquare = row.inverseSquare.data();
    const double* const inverse = row.inverse.data();
    const double* const scene = row.scene.data();
#pragma GCC ivdep
    for (std::size_t i = first; i < first + group; ++i) {
        const double u = slopesX[i] - puff.x0;
        const double exponent = puff.logDepth - (puff.gamma * u * u + puff.kappa) * inverseSquare[i];
        const double depth = powerOfTwo(exponent > minimumExponent ? exponent : minimumExponent);
        const double foot = (puff.footAtZero + puff.footPerSlope * slopesX[i]) * inverse[i];
        const double begin = cutByEye ? halfErf(-foot * puff.inverseWidth) : -0.5;
        const double finish = halfErf((scene[i] - foot) * puff.inverseWidth);
        sums[i] += depth * (finish - begin);
    }
}

/// Groups [first, end) of the row. Returns how many pixels were computed.
std::int64_t addGroups(const DepthPuff& puff, double extentMetres, double footRangeMetres, const double* slopesX,
                       Row& row, std::size_t first, std::size_t end) {
    std::int64_t computed = 0;
    for (std::size_t g = first; g < end; ++g) {
        const std::size_t i = g * group;
        // The foot at the group's middle, and bounds that hold for the whole group.
        const double foot = (puff.footAtZero + puff.footPerSlope * slopesX[i + group / 2]) * row.inverse[i + group / 2];
        const double nearMetres = foot - footRangeMetres - extentMetres;
        const double farMetres = foot + footRangeMetres + extentMetres;
        if (farMetres <= 0 || row.farthest[g] <= nearMetres) continue;  // behind the eye or the scene
        ++computed;
        if (nearMetres < 0)
            addCut<true>(puff, slopesX, row, i);
        else if (row.nearest[g] < farMetres)
            addCut<false>(puff, slopesX, row, i);
        else
            addWhole(puff, slopesX, row, i);
    }
    return computed * group;
}

}  // namespace

DepthSum sumDepths(const std::vector<Puff>& puffs, const CameraRays& rays, const OpaqueDistances& distances) {
    const auto width = static_cast<std::size_t>(rays.width());
    const std::size_t padded = (width + group - 1) / group * group;
    std::vector<double> slopesX(padded);
    for (std::size_t i = 0; i < padded; ++i) slopesX[i] = rays.columnSlope(static_cast<int>(i));

    DepthSum sum{std::vector<double>(distances.metres.size())};
    std::atomic<std::int64_t> evaluations = 0;
    parallel::forEachBlock(
        static_cast<std::size_t>(rays.height()), rowsAtOnce, [&](std::size_t from, std::size_t count) {
            std::vector<Row> rows(count, Row(padded));
            for (std::size_t k = 0; k < count; ++k)
                rows[k].begin(rays.rowSlope(static_cast<int>(from + k)), slopesX, &distances.metres[(from + k) * width],
                              width);
            std::int64_t done = 0;
            for (const Puff& puff : puffs) {
                const int first = std::max(puff.firstRow, static_cast<int>(from));
                const int end = std::min(puff.endRow, static_cast<int>(from + count));
                if (first >= end) continue;
                const double extent = sigmasAlongRay * puff.deviationMetres;
                // From the group's middle to its edge, a ray turns by less than the difference in slope, so the foot
                // moves by less than that times the centre's distance.
                const double footRange = glm::length(puff.centre) * (group / 2.0) * (slopesX[1] - slopesX[0]);
                // exp(−b²/2s²) = 2^(−b²·log2(e)/2s²).
                const double scale = std::numbers::log2e / (2 * puff.deviationMetres * puff.deviationMetres);
                const double logDepth = std::log2(puff.opticalDepth);
                for (int y = first; y < end; ++y) {
                    Row& row = rows[static_cast<std::size_t>(y) - from];
                    const RowGeometry geometry = rowGeometry(puff, row.slopeY);
                    const Columns columns = columnsOf(puff, geometry, row.slopeY, rays);
                    if (columns.first == columns.end) continue;
                    const DepthPuff rowPuff{logDepth,
                                            geometry.gamma * scale,
                                            geometry.x0,
                                            geometry.kappa * scale,
                                            geometry.footAtZero,
                                            geometry.footPerSlope,
                                            1 / (std::numbers::sqrt2 * puff.deviationMetres)};
                    done += addGroups(rowPuff, extent, footRange, slopesX.data(), row,
                                      static_cast<std::size_t>(columns.first) / group,
                                      (static_cast<std::size_t>(columns.end) + group - 1) / group);
                }
            }
            for (std::size_t k = 0; k < count; ++k)
                std::copy_n(rows[k].sums.begin(), width,
                            sum.depths.begin() + static_cast<std::ptrdiff_t>((from + k) * width));
            evaluations += done;
        });
    sum.evaluations = evaluations;
    return sum;
}

}  // namespace dustbench::reference
