#include "methods/kit/raycast/plain_march.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dustbench::raycast {
namespace {

/// Weights of the cells ⌊x⌋ − 1 … ⌊x⌋ + 2 at a position x = ⌊x⌋ + t.
std::array<double, 4> weightsOf(Filter filter, double t) {
    if (filter == Filter::nearest) return t < 0.5 ? std::array{0.0, 1.0, 0.0, 0.0} : std::array{0.0, 0.0, 1.0, 0.0};
    if (filter == Filter::linear) return {0, 1 - t, t, 0};
    const double s = 1 - t;  // the cubic B-spline
    return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
}

/// Interpolates `values` of `cells` cells at a position; constant beyond the outermost middles.
double sample(std::span<const float> values, glm::ivec3 cells, Filter filter, glm::dvec3 place) {
    const glm::dvec3 fromMiddle = place - 0.5;
    const glm::ivec3 low(glm::floor(fromMiddle));
    std::array<std::array<double, 4>, 3> weights;
    for (int axis = 0; axis < 3; ++axis)
        weights[static_cast<std::size_t>(axis)] = weightsOf(filter, fromMiddle[axis] - low[axis]);
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const glm::ivec3 at = glm::clamp(low + glm::ivec3(i, j, k) - 1, glm::ivec3(0), cells - 1);
                const auto cell = static_cast<std::size_t>(at.x + cells.x * (at.y + cells.y * at.z));
                const auto w = [&](std::size_t axis, int n) { return weights[axis][static_cast<std::size_t>(n)]; };
                sum += w(0, i) * w(1, j) * w(2, k) * static_cast<double>(values[cell]);
            }
    return sum;
}

/// Emission and extinction factor of fire: linear between the table's texels.
glm::dvec4 burningAt(const std::vector<glm::vec4>& table, double reaction) {
    const double at = std::clamp(reaction, 0.0, 1.0) * static_cast<double>(table.size() - 1);
    const auto texel = static_cast<std::size_t>(at);
    const std::size_t next = std::min(texel + 1, table.size() - 1);
    return glm::mix(glm::dvec4(table[texel]), glm::dvec4(table[next]), at - std::floor(at));
}

/// Visits the steps from front to back until `visit` returns false.
template <typename Visit>
void forEachStep(const PlainVolume& volume, const PlainRay& ray, const Visit& visit) {
    const auto& [grid, settings, reflected, light] = volume;
    double enter = 0, leave = ray.end;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = -ray.eye[axis] / ray.along[axis], b = (grid.cells[axis] - ray.eye[axis]) / ray.along[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    const double sigma = settings.extinctionPerMetre * grid.spacingMetres;
    const double step = settings.stepCells, shift = ray.jitter * step;
    const std::vector<glm::vec4> fire = settings.fire.table();
    const auto phase = static_cast<double>(reflected.phase(glm::vec3(ray.along)));
    for (double k = std::floor((enter - shift) / step); k * step + shift < leave; ++k) {
        const double from = std::max(k * step + shift, enter), to = std::min((k + 1) * step + shift, leave);
        if (from >= to) continue;
        const glm::dvec3 middle = ray.eye + 0.5 * (from + to) * ray.along;
        double extinction = sigma * sample(grid.density, grid.cells, settings.filter, middle);
        double lit = 1;
        if (!light.empty()) {
            const int texel = settings.shadowCells;
            lit = phase *
                  sample(light, (grid.cells + texel - 1) / texel, Filter::linear, middle / static_cast<double>(texel));
        }
        glm::dvec3 source = glm::dvec3(reflected.ambient) + lit * glm::dvec3(reflected.sun);
        if (!grid.reaction.empty()) {
            const glm::dvec4 burning = burningAt(fire, sample(grid.reaction, grid.cells, settings.filter, middle));
            extinction *= burning.a;
            source += glm::dvec3(burning);
        }
        if (!visit(PlainStep{extinction * (to - from), source})) return;
    }
}

}  // namespace

glm::dvec4 plainMarch(const PlainVolume& volume, const PlainRay& ray) {
    const double opaque = -std::log1p(-volume.settings.stopAlpha);
    double depth = 0;
    glm::dvec3 colour(0);
    forEachStep(volume, ray, [&](const PlainStep& step) {
        const double next = depth + step.depth;
        colour += (std::exp(-depth) - std::exp(-next)) * step.source;
        depth = next;
        return depth <= opaque;
    });
    return {colour, -std::expm1(-depth)};
}

std::vector<PlainStep> plainSteps(const PlainVolume& volume, const PlainRay& ray) {
    std::vector<PlainStep> steps;
    forEachStep(volume, ray, [&](const PlainStep& step) {
        steps.push_back(step);
        return true;
    });
    return steps;
}

double plainJitter(int x, int y) {
    const double sum = (x * 3242174889.0 + y * 2447445414.0) / 4294967296.0;
    return sum - std::floor(sum);
}

}  // namespace dustbench::raycast
