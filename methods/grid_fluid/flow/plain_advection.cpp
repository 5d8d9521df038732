#include "methods/grid_fluid/flow/plain_advection.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

#include "methods/grid_fluid/flow/evened_corrections.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// The places where the quantities of a cell are sampled, in cells from that of the first ghost.
struct PlainPlaces {
    std::array<glm::dvec3, 4> at;  ///< of the faces across x, y, z and of the centre
    [[nodiscard]] const glm::dvec3& of(std::size_t lane) const { return at[std::min<std::size_t>(lane, 3)]; }
};

/// Calls `take(cell, nearest cell in the box)` for all padded cells.
template <typename Take>
void forPadded(const CellLayout& layout, const Take& take) {
    const glm::ivec3 size(layout.nx, layout.ny, layout.nz);
    for (int k = -1; k <= size.z; ++k)
        for (int j = -1; j <= size.y; ++j)
            for (int i = -1; i <= size.x; ++i)
                take(glm::ivec3(i, j, k), glm::clamp(glm::ivec3(i, j, k), glm::ivec3(0), size - 1));
}

/// φ at such places.
struct Field {
    const CellLayout& layout;
    std::vector<PlainRecord> values;

    /// Calls `take(φ of a corner, weight)` for the eight numbers of a quantity around its place.
    template <typename Take>
    void around(const glm::dvec3& x, std::size_t lane, const Take& take) const {
        const glm::ivec3 corner = glm::min(glm::ivec3(glm::floor(x)), glm::ivec3(layout.nx, layout.ny, layout.nz));
        const glm::dvec3 f = x - glm::dvec3(corner);
        for (const int i : {0, 1})
            for (const int j : {0, 1})
                for (const int k : {0, 1})
                    take(values[layout.at(corner.x + i - 1, corner.y + j - 1, corner.z + k - 1)][lane],
                         (i == 1 ? f.x : 1 - f.x) * (j == 1 ? f.y : 1 - f.y) * (k == 1 ? f.z : 1 - f.z));
    }
    [[nodiscard]] double at(const glm::dvec3& x, std::size_t lane) const {
        double sum = 0;
        around(x, lane, [&](double phi, double weight) { sum += weight * phi; });
        return sum;
    }
};

double limited(Limit limit, double corrected, double guess, double minimum, double maximum) {
    if (limit == Limit::clamp) return std::clamp(corrected, minimum, maximum);
    if (limit == Limit::revert && (corrected < minimum || corrected > maximum)) return guess;
    return corrected;
}

/// Paths of cells and faces through the velocities at one time.
class Paths {
 public:
    Paths(const CellLayout& layout, std::vector<glm::dvec3> centres, double dt)
        : layout_(layout), size_(layout.nx, layout.ny, layout.nz), dt_(dt), centre_(std::move(centres)) {
        halfway_ = centre_;
        forPadded(layout, [&](glm::ivec3 cell, glm::ivec3 inner) {
            const glm::dvec3 x(inner + 1), u = centre_[layout_.at(inner.x, inner.y, inner.z)];
            halfway_[layout_.at(cell.x, cell.y, cell.z)] =
                velocity(glm::clamp(x - 0.5 * dt_ * u, glm::dvec3(0), glm::dvec3(size_ + 1)));
        });
    }
    /// x₋ = x − Δt·u, and from there 2Δt·u(x) on.
    struct Ends {
        PlainPlaces began, ahead;
    };
    [[nodiscard]] Ends of(glm::ivec3 cell) const {
        Ends ends;
        const glm::dvec3 x(cell + 1);
        for (int place = 0; place < 4; ++place) {
            glm::ivec3 other = cell;
            if (place < 3) other[place] -= 1;
            const std::size_t a = layout_.at(cell.x, cell.y, cell.z), b = layout_.at(other.x, other.y, other.z);
            glm::dvec3 began = x - dt_ * 0.5 * (halfway_[a] + halfway_[b]);
            began = glm::clamp(began, glm::dvec3(0), glm::dvec3(size_ + 1));
            ends.began.at[static_cast<std::size_t>(place)] = began;
            ends.ahead.at[static_cast<std::size_t>(place)] = began + 2 * dt_ * 0.5 * (centre_[a] + centre_[b]);
        }
        return ends;
    }

 private:
    [[nodiscard]] glm::dvec3 velocity(glm::dvec3 x) const {
        const glm::ivec3 corner = glm::min(glm::ivec3(glm::floor(x)), size_);
        const glm::dvec3 f = x - glm::dvec3(corner);
        glm::dvec3 sum(0);
        for (const int i : {0, 1})
            for (const int j : {0, 1})
                for (const int k : {0, 1})
                    sum += centre_[layout_.at(corner.x + i - 1, corner.y + j - 1, corner.z + k - 1)] *
                           ((i == 1 ? f.x : 1 - f.x) * (j == 1 ? f.y : 1 - f.y) * (k == 1 ? f.z : 1 - f.z));
        return sum;
    }

    const CellLayout& layout_;
    glm::ivec3 size_;
    double dt_;
    std::vector<glm::dvec3> centre_, halfway_;
};

}  // namespace

std::vector<glm::dvec3> plainCentres(const CellField& cells, const CellLayout& layout) {
    std::vector<glm::dvec3> centres(layout.padded());
    forPadded(layout, [&](glm::ivec3 cell, glm::ivec3 inner) {
        const std::size_t own = layout.at(inner.x, inner.y, inner.z);
        const std::array<std::size_t, 3> next{own + 1, own + layout.row, own + layout.slab};
        glm::dvec3& u = centres[layout.at(cell.x, cell.y, cell.z)];
        for (std::size_t axis = 0; axis < 3; ++axis)
            u[static_cast<int>(axis)] =
                0.5 * (static_cast<double>(cells.cell(own)[axis]) + static_cast<double>(cells.cell(next[axis])[axis]));
    });
    return centres;
}

std::vector<PlainRecord> plainAdvection(const CellField& from, const CellLayout& layout, const Moving* moving,
                                        AdvectionRule rule, double dt, double maximumSpeedZ,
                                        const PlainExtrapolation* extrapolation) {
    Field phi{layout, std::vector<PlainRecord>(layout.padded())};
    for (std::size_t at = 0; at < layout.padded(); ++at) std::copy_n(from.cell(at), lanes, phi.values[at].begin());
    std::vector<glm::dvec3> centres = plainCentres(from, layout);
    if (extrapolation != nullptr)
        for (std::size_t at = 0; at < layout.padded(); ++at) {
            const glm::dvec3 u = centres[at], most = extrapolation->maximumSpeeds;
            centres[at] = glm::clamp(u + extrapolation->ahead * (u - extrapolation->last[at]), -most, most);
        }
    const Paths paths(layout, std::move(centres), dt);
    const auto forMoving = [&](const auto& take) {
        for (int k = 0; k < layout.nz; ++k)
            for (int j = 0; j < layout.ny; ++j)
                for (int i = 0; i < layout.nx; ++i) {
                    const std::size_t at = layout.at(i, j, k);
                    const auto [began, ahead] = paths.of({i, j, k});
                    for (std::size_t lane = 0; lane < lanes; ++lane)
                        if ((moving[at] >> std::min<std::size_t>(lane, 3) & 1) != 0)
                            take(at, lane, k, began.of(lane), ahead.of(lane));
                }
    };

    Field guess = phi;
    forMoving([&](std::size_t at, std::size_t lane, int, const glm::dvec3& began, const glm::dvec3&) {
        guess.values[at][lane] = phi.at(began, lane);
    });
    if (rule.scheme == AdvectionScheme::semiLagrangian) return guess.values;

    std::vector<PlainRecord> corrections(layout.padded());
    // The first guess is kept if a path leaves the box, or goes farther along z than the maximum speed.
    const double maximumSlabs = std::ceil(dt * maximumSpeedZ) + 1;
    forMoving([&](std::size_t at, std::size_t lane, int k, const glm::dvec3& began, const glm::dvec3& ahead) {
        glm::dvec3 last(layout.nx, layout.ny, layout.nz);
        if (lane < 3) last[static_cast<int>(lane)] += 1;  // the face on the far side
        const auto tolerance = static_cast<double>(pathTolerance);
        const glm::dvec3 low(1, 1, std::max(1.0, k + 1 - maximumSlabs));
        last.z = std::min(last.z, k + 1 + maximumSlabs);
        const auto leaves = [&](const glm::dvec3& x) {
            return glm::any(glm::lessThan(x, low - tolerance)) || glm::any(glm::greaterThan(x, last + tolerance));
        };
        if (leaves(began) || leaves(ahead)) return;
        double minimum = INFINITY, maximum = -INFINITY;
        phi.around(began, lane, [&](double corner, double) {
            minimum = std::min(minimum, corner);
            maximum = std::max(maximum, corner);
        });
        const double corrected =
            guess.values[at][lane] + 0.5 * (phi.values[at][lane] - guess.at(glm::clamp(ahead, low, last), lane));
        corrections[at][lane] =
            limited(rule.limit, corrected, guess.values[at][lane], minimum, maximum) - guess.values[at][lane];
    });
    const auto correctionAt = [&](glm::ivec3 cell, std::size_t lane) {
        const glm::ivec3 last = glm::ivec3(layout.nx, layout.ny, layout.nz) - 1;
        if (lane < 3 && cell[static_cast<int>(lane)] > last[static_cast<int>(lane)]) return 0.0;  // of the far side
        cell = glm::clamp(cell, glm::ivec3(0), last);
        return corrections[layout.at(cell.x, cell.y, cell.z)][lane];
    };
    std::vector<PlainRecord> result = guess.values;
    for (int k = 0; k < layout.nz; ++k)
        for (int j = 0; j < layout.ny; ++j)
            for (int i = 0; i < layout.nx; ++i)
                for (std::size_t lane = 0; lane < lanes; ++lane) {
                    const glm::ivec3 cell(i, j, k);
                    const double own = correctionAt(cell, lane);
                    double least = own, most = own;
                    for (const glm::ivec3 step : {glm::ivec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}) {
                        const double evened =
                            static_cast<double>(lane < 3 ? keptOfSpeeds : keptOfCentres) / 4 *
                            (correctionAt(cell - step, lane) + 2 * own + correctionAt(cell + step, lane));
                        least = std::min(least, evened);
                        most = std::max(most, evened);
                    }
                    result[layout.at(i, j, k)][lane] += std::max(least, 0.0) + std::min(most, 0.0);
                }
    return result;
}

}  // namespace dustbench::grid_fluid::flow
