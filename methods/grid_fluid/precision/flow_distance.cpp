#include "methods/grid_fluid/precision/flow_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dustbench::grid_fluid::precision {
namespace {

double squareOf(double value) {
    return value * value;
}

double squareOfDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += squareOf(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    return sum;
}

double squareOf(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += squareOf(static_cast<double>(value));
    return sum;
}

template <typename Take>
void forEach(const glm::ivec3& first, const glm::ivec3& end, const Take& take) {
    for (glm::ivec3 at(first); at.z < end.z; ++at.z)
        for (at.y = first.y; at.y < end.y; ++at.y)
            for (at.x = first.x; at.x < end.x; ++at.x) take(at);
}

/// ω of an edge is the circulation of the four faces around it. Edges on the box's sides are omitted.
double enstrophyOf(const StaggeredFlow& flow) {
    double sum = 0;
    const auto speed = [&](int axis, const glm::ivec3& at) {
        return static_cast<double>(flow.speeds[static_cast<std::size_t>(axis)][flow.face(axis, at.x, at.y, at.z)]);
    };
    for (int along = 0; along < 3; ++along) {
        const int a = (along + 1) % 3, b = (along + 2) % 3;
        glm::ivec3 first(0), nextA(0), nextB(0);
        first[a] = first[b] = nextA[a] = nextB[b] = 1;
        forEach(first, flow.cells, [&](const glm::ivec3& at) {
            sum += squareOf(speed(b, at) - speed(b, at - nextA) - speed(a, at) + speed(a, at - nextB));
        });
    }
    return sum;
}

/// Coefficients of the cosine series of the speeds at the centres along an axis.
std::vector<double> seriesOf(const StaggeredFlow& flow, int axis) {
    glm::ivec3 next(0);
    next[axis] = 1;
    std::vector<double> values;
    const std::vector<float>& speeds = flow.speeds[static_cast<std::size_t>(axis)];
    forEach(glm::ivec3(0), flow.cells, [&](const glm::ivec3& at) {
        const glm::ivec3 behind = at + next;
        values.push_back(0.5 * (static_cast<double>(speeds[flow.face(axis, at.x, at.y, at.z)]) +
                                static_cast<double>(speeds[flow.face(axis, behind.x, behind.y, behind.z)])));
    });
    for (int along = 0; along < 3; ++along) {
        const int n = flow.cells[along];
        std::vector<double> line(static_cast<std::size_t>(n)), cosines;
        for (int k = 0; k < n; ++k)
            for (int i = 0; i < n; ++i)
                cosines.push_back(std::sqrt((k == 0 ? 1.0 : 2.0) / n) * std::cos(std::numbers::pi * k * (i + 0.5) / n));
        glm::ivec3 end = flow.cells;
        end[along] = 1;
        forEach(glm::ivec3(0), end, [&](glm::ivec3 at) {
            const auto valueAt = [&](int i) -> double& {
                at[along] = i;
                return values[flow.cell(at.x, at.y, at.z)];
            };
            for (int i = 0; i < n; ++i) line[static_cast<std::size_t>(i)] = valueAt(i);
            for (int k = 0; k < n; ++k) {
                double sum = 0;
                for (int i = 0; i < n; ++i)
                    sum += cosines[static_cast<std::size_t>(k * n + i)] * line[static_cast<std::size_t>(i)];
                valueAt(k) = sum;
            }
        });
    }
    return values;
}

/// Energy by wave number, in half waves per width along z.
std::vector<double> spectrumOf(const StaggeredFlow& flow) {
    const int width = flow.cells.z;
    std::vector<double> energy(static_cast<std::size_t>(width));
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double> series = seriesOf(flow, axis);
        forEach(glm::ivec3(0), flow.cells, [&](const glm::ivec3& at) {
            const glm::dvec3 waves = glm::dvec3(at) * static_cast<double>(width) / glm::dvec3(flow.cells);
            const auto number = static_cast<std::size_t>(std::lround(glm::length(waves)));
            if (number < energy.size()) energy[number] += squareOf(series[flow.cell(at.x, at.y, at.z)]);
        });
    }
    return energy;
}

}  // namespace

StaggeredFlow averaged(const StaggeredFlow& flow, int refinement) {
    StaggeredFlow coarse(flow.cells / refinement);
    for (int axis = -1; axis < 3; ++axis) {
        glm::ivec3 block(refinement);
        if (axis >= 0) block[axis] = 1;
        const bool isDensity = axis < 0;
        const auto& fine = isDensity ? flow.density : flow.speeds[static_cast<std::size_t>(axis)];
        auto& mean = isDensity ? coarse.density : coarse.speeds[static_cast<std::size_t>(axis)];
        forEach(glm::ivec3(0), coarse.faces(axis), [&](const glm::ivec3& at) {
            double sum = 0;
            const glm::ivec3 first = at * refinement;
            forEach(first, first + block, [&](const glm::ivec3& of) {
                sum += static_cast<double>(
                    fine[isDensity ? flow.cell(of.x, of.y, of.z) : flow.face(axis, of.x, of.y, of.z)]);
            });
            mean[isDensity ? coarse.cell(at.x, at.y, at.z) : coarse.face(axis, at.x, at.y, at.z)] =
                static_cast<float>(sum / (block.x * block.y * block.z));
        });
    }
    return coarse;
}

FlowDistance distanceOf(const StaggeredFlow& flow, const StaggeredFlow& reference) {
    FlowDistance distance;
    distance.density = std::sqrt(squareOfDifference(flow.density, reference.density) / squareOf(reference.density));
    double apart = 0, whole = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart += squareOfDifference(flow.speeds[axis], reference.speeds[axis]);
        whole += squareOf(reference.speeds[axis]);
    }
    distance.velocity = std::sqrt(apart / whole);
    distance.enstrophy = std::abs(std::log(enstrophyOf(flow) / enstrophyOf(reference)));
    const std::vector<double> energy = spectrumOf(flow), expected = spectrumOf(reference);
    double sum = 0;
    for (std::size_t number = 1; number < energy.size(); ++number)
        sum += squareOf(std::log(energy[number] / expected[number]));
    distance.spectrum = std::sqrt(sum / static_cast<double>(energy.size() - 1));
    return distance;
}

FlowSums sumsOf(const StaggeredFlow& flow, std::span<const std::uint8_t> solids, double spacingMetres,
                double stepSeconds) {
    FlowSums sums;
    const double volume = spacingMetres * spacingMetres * spacingMetres;
    for (const float density : flow.density) sums.massM3 += static_cast<double>(density) * volume;
    for (const std::vector<float>& speeds : flow.speeds) sums.energyM5PerS2 += squareOf(speeds) / 2 * volume;
    forEach(glm::ivec3(0), flow.cells, [&](const glm::ivec3& at) {
        if (!solids.empty() && solids[flow.cell(at.x, at.y, at.z)] != 0) return;
        double out = 0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 behind = at;
            ++behind[axis];
            const std::vector<float>& speeds = flow.speeds[static_cast<std::size_t>(axis)];
            out += static_cast<double>(speeds[flow.face(axis, behind.x, behind.y, behind.z)]) -
                   static_cast<double>(speeds[flow.face(axis, at.x, at.y, at.z)]);
        }
        sums.divergencePerStep = std::max(sums.divergencePerStep, std::abs(out) * stepSeconds / spacingMetres);
    });
    return sums;
}

}  // namespace dustbench::grid_fluid::precision
