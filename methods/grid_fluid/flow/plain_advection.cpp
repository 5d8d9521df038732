#include "methods/grid_fluid/flow/plain_advection.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {
namespace {

/// φ at positions in cells from the centre of the first ghost cell.
struct Field {
    const CellLayout& layout;
    std::vector<PlainRecord> values;

    /// Calls `take(φ of a cell, weight)` for the eight cells around a position.
    template <typename Take>
    void around(glm::dvec3 x, const Take& take) const {
        const glm::ivec3 cell = glm::min(glm::ivec3(glm::floor(x)), glm::ivec3(layout.nx, layout.ny, layout.nz));
        const glm::dvec3 f = x - glm::dvec3(cell);
        for (const int i : {0, 1})
            for (const int j : {0, 1})
                for (const int k : {0, 1})
                    take(values[layout.at(cell.x + i - 1, cell.y + j - 1, cell.z + k - 1)],
                         (i == 1 ? f.x : 1 - f.x) * (j == 1 ? f.y : 1 - f.y) * (k == 1 ? f.z : 1 - f.z));
    }
    [[nodiscard]] PlainRecord at(glm::dvec3 x) const {
        PlainRecord sum{};
        around(x, [&](const PlainRecord& phi, double weight) {
            for (std::size_t lane = 0; lane < lanes; ++lane) sum[lane] += weight * phi[lane];
        });
        return sum;
    }
    [[nodiscard]] glm::dvec3 velocity(glm::dvec3 x) const {
        const PlainRecord phi = at(x);
        return {phi[velocityX], phi[velocityY], phi[velocityZ]};
    }
};

double limited(Limit limit, double corrected, double guess, double minimum, double maximum) {
    if (limit == Limit::clamp) return std::clamp(corrected, minimum, maximum);
    if (limit == Limit::revert && (corrected < minimum || corrected > maximum)) return guess;
    return corrected;
}

}  // namespace

std::vector<PlainRecord> plainAdvection(const CellField& from, const CellLayout& layout, const std::uint8_t* fluid,
                                        AdvectionRule rule, double dt, double maximumSpeedZ) {
    Field phi{layout, std::vector<PlainRecord>(layout.padded())};
    for (std::size_t at = 0; at < layout.padded(); ++at) std::copy_n(from.cell(at), lanes, phi.values[at].begin());
    const glm::dvec3 last(layout.nx + 1, layout.ny + 1, layout.nz + 1);  // centre of the last ghost cell
    const auto within = [&](glm::dvec3 x) { return glm::clamp(x, glm::dvec3(0), last); };
    const auto behind = [&](glm::dvec3 x) {
        return within(x - dt * phi.velocity(within(x - 0.5 * dt * phi.velocity(x))));
    };
    const auto forFluid = [&](const auto& cell) {
        for (int k = 0; k < layout.nz; ++k)
            for (int j = 0; j < layout.ny; ++j)
                for (int i = 0; i < layout.nx; ++i)
                    if (fluid[layout.at(i, j, k)] == 1) cell(layout.at(i, j, k), glm::dvec3(i + 1, j + 1, k + 1));
    };

    Field guess = phi;
    forFluid([&](std::size_t at, glm::dvec3 x) { guess.values[at] = phi.at(behind(x)); });
    if (rule.scheme == AdvectionScheme::semiLagrangian) return guess.values;

    std::vector<PlainRecord> result = guess.values;
    // The first guess is kept if a path leaves the box, or goes farther along z than the maximum speed.
    const double maximumSlabs = std::ceil(dt * maximumSpeedZ) + 1;
    const auto leaves = [&](glm::dvec3 x) {
        return glm::any(glm::lessThan(x, glm::dvec3(1))) || glm::any(glm::greaterThan(x, last - 1.0));
    };
    forFluid([&](std::size_t at, glm::dvec3 x) {
        const glm::dvec3 began = behind(x), ahead = began + 2 * dt * phi.velocity(x);
        if (leaves(began) || leaves(ahead) || std::fabs(ahead.z - x.z) > maximumSlabs) return;
        const PlainRecord there = guess.at(ahead);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            double minimum = INFINITY, maximum = -INFINITY;
            phi.around(began, [&](const PlainRecord& corner, double) {
                minimum = std::min(minimum, corner[lane]);
                maximum = std::max(maximum, corner[lane]);
            });
            const double corrected = guess.values[at][lane] + 0.5 * (phi.values[at][lane] - there[lane]);
            result[at][lane] = limited(rule.limit, corrected, guess.values[at][lane], minimum, maximum);
        }
    });
    return result;
}

}  // namespace dustbench::grid_fluid::flow
