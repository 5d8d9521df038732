#include "methods/voxel_shape/voxels/elastic_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::size_t corners = 8, freedoms = 3 * corners, strains = 6;
constexpr std::size_t elementsABlock = 256, numbersABlock = 4096;
constexpr double smallestResidual = 1e-8;  ///< relative to the load's
constexpr std::size_t minimumIterations = 1000, iterationsPerNode = 2;

using Strain = std::array<std::array<double, freedoms>, strains>;      ///< B: strain by displacements
using Elasticity = std::array<std::array<double, strains>, strains>;   ///< C: stress by strain
using Stiffness = std::array<std::array<double, freedoms>, freedoms>;  ///< K of a unit cube
using Numbers = std::vector<double>;                                   ///< three per node

glm::ivec3 cornerAt(std::size_t c) {
    return {static_cast<int>(c & 1), static_cast<int>(c >> 1 & 1), static_cast<int>(c >> 2)};
}

/// In the order xx, yy, zz, xy, yz, zx; shear strains are γ = 2ε. Young's modulus 1.
Elasticity elasticityOf(double poisson) {
    const double lambda = poisson / ((1 + poisson) * (1 - 2 * poisson)), mu = 1 / (2 * (1 + poisson));
    Elasticity c{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) c[i][j] = lambda;
        c[i][i] += 2 * mu;
        c[i + 3][i + 3] = mu;
    }
    return c;
}

/// B at a point of the unit cube, from the gradients of N_c = Π_axis (corner ? x : 1 − x).
Strain strainAt(const glm::dvec3& point) {
    Strain b{};
    for (std::size_t c = 0; c < corners; ++c) {
        const glm::dvec3 corner(cornerAt(c)), part = glm::mix(1.0 - point, point, corner), slope = 2.0 * corner - 1.0;
        const double x = slope.x * part.y * part.z, y = slope.y * part.x * part.z, z = slope.z * part.x * part.y;
        b[0][3 * c] = b[3][3 * c + 1] = b[5][3 * c + 2] = x;
        b[1][3 * c + 1] = b[3][3 * c] = b[4][3 * c + 2] = y;
        b[2][3 * c + 2] = b[4][3 * c + 1] = b[5][3 * c] = z;
    }
    return b;
}

/// K = ∫ Bᵀ·C·B over the unit cube.
Stiffness stiffnessOf(const Elasticity& c) {
    Stiffness k{};
    const double off = 0.5 / std::sqrt(3.0);
    for (std::size_t point = 0; point < corners; ++point) {
        const Strain b = strainAt(0.5 + off * (2.0 * glm::dvec3(cornerAt(point)) - 1.0));
        for (std::size_t i = 0; i < freedoms; ++i)
            for (std::size_t j = 0; j < freedoms; ++j)
                for (std::size_t r = 0; r < strains; ++r)
                    for (std::size_t s = 0; s < strains; ++s) k[i][j] += b[r][i] * c[r][s] * b[s][j] / corners;
    }
    return k;
}

double vonMises(const std::array<double, strains>& s) {
    const auto square = [](double v) { return v * v; };
    return std::sqrt((square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0])) / 2 +
                     3 * (square(s[3]) + square(s[4]) + square(s[5])));
}

double product(const Numbers& a, const Numbers& b) {
    std::vector<double> sums((a.size() + numbersABlock - 1) / numbersABlock, 0);
    parallel::forEachBlock(a.size(), numbersABlock, [&](std::size_t first, std::size_t count) {
        double sum = 0;
        for (std::size_t i = first; i < first + count; ++i) sum += a[i] * b[i];
        sums[first / numbersABlock] = sum;
    });
    double sum = 0;
    for (const double each : sums) sum += each;
    return sum;
}

/// The voxels as elements. Displacements are in voxel edges times Young's modulus by newtons, so that K has no units.
class Elements {
 public:
    Elements(const VoxelGrid& grid, const ElasticLoad& load);

    [[nodiscard]] std::size_t nodes() const { return fixed_.size(); }
    [[nodiscard]] const Numbers& force() const { return force_; }
    [[nodiscard]] const Numbers& diagonal() const { return diagonal_; }
    /// result = K·u, 0 at fixed nodes, where u must be 0.
    void multiply(const Numbers& u, Numbers& result) const;
    /// Von Mises stress at the centre of element `e`, for voxels with an edge of 1 m.
    [[nodiscard]] double stress(std::size_t e, const Numbers& u) const;

 private:
    void number(const VoxelGrid& grid);
    void addForce(const std::vector<std::uint32_t>& loaded, const glm::dvec3& newtons);
    [[nodiscard]] std::array<double, freedoms> displacements(std::size_t e, const Numbers& u) const;

    Elasticity elasticity_;
    Stiffness stiffness_;
    Strain atCentre_;
    std::vector<std::array<std::uint32_t, corners>> elements_;  ///< nodes, of the active voxels
    std::array<std::vector<std::uint32_t>, corners> parities_;  ///< elements that share no node, by their cell's parity
    std::vector<bool> fixed_;
    Numbers force_, diagonal_;
};

Elements::Elements(const VoxelGrid& grid, const ElasticLoad& load)
    : elasticity_(elasticityOf(load.poisson)),
      stiffness_(stiffnessOf(elasticity_)),
      atCentre_(strainAt(glm::dvec3(0.5))) {
    number(grid);
    std::vector<std::uint32_t> loaded;
    bool isHeld = false;
    for (std::uint32_t e = 0; e < elements_.size(); ++e) {
        const glm::vec3 centre = grid.lattice().centre(grid.lattice().cell(grid.active()[e]));
        if (load.loaded.contains(centre)) loaded.push_back(e);
        if (!load.held.contains(centre)) continue;
        isHeld = true;
        for (const std::uint32_t node : elements_[e]) fixed_[node] = true;
    }
    for (const auto& [found, box] : {std::pair(!loaded.empty(), "at"), std::pair(isHeld, "held")})
        if (!found) throw InputError(fmt::format("{}[load]: box '{}' contains no voxel", load.where, box));
    addForce(loaded, glm::dvec3(load.newtons));
    diagonal_.assign(3 * nodes(), 0);
    for (const auto& element : elements_)
        for (std::size_t i = 0; i < freedoms; ++i) diagonal_[3 * element[i / 3] + i % 3] += stiffness_[i][i];
}

/// Numbers the corners of active voxels in the order of the lattice.
void Elements::number(const VoxelGrid& grid) {
    Lattice points = grid.lattice();
    points.counts += 1;
    constexpr std::uint32_t none = 0xffffffffu;
    std::vector<std::uint32_t> nodeAt(points.size(), none);
    for (const std::uint32_t voxel : grid.active()) {
        const glm::ivec3 cell = grid.lattice().cell(voxel);
        for (std::size_t c = 0; c < corners; ++c) nodeAt[points.index(cell + cornerAt(c))] = 0;
    }
    std::uint32_t count = 0;
    for (std::uint32_t& node : nodeAt)
        if (node != none) node = count++;
    fixed_.assign(count, false);
    for (const std::uint32_t voxel : grid.active()) {
        const glm::ivec3 cell = grid.lattice().cell(voxel);
        const auto parity = static_cast<std::size_t>((cell.x & 1) + 2 * (cell.y & 1) + 4 * (cell.z & 1));
        parities_[parity].push_back(static_cast<std::uint32_t>(elements_.size()));
        std::array<std::uint32_t, corners>& element = elements_.emplace_back();
        for (std::size_t c = 0; c < corners; ++c) element[c] = nodeAt[points.index(cell + cornerAt(c))];
    }
}

void Elements::addForce(const std::vector<std::uint32_t>& loaded, const glm::dvec3& newtons) {
    force_.assign(3 * nodes(), 0);
    const glm::dvec3 each = newtons / static_cast<double>(corners * loaded.size());
    for (const std::uint32_t e : loaded)
        for (const std::uint32_t node : elements_[e])
            for (int axis = 0; axis < 3; ++axis)
                force_[3 * node + static_cast<std::size_t>(axis)] += fixed_[node] ? 0 : each[axis];
}

std::array<double, freedoms> Elements::displacements(std::size_t e, const Numbers& u) const {
    std::array<double, freedoms> own;
    for (std::size_t i = 0; i < freedoms; ++i) own[i] = u[3 * elements_[e][i / 3] + i % 3];
    return own;
}

void Elements::multiply(const Numbers& u, Numbers& result) const {
    std::ranges::fill(result, 0);
    for (const auto& elements : parities_)
        parallel::forEachBlock(elements.size(), elementsABlock, [&](std::size_t first, std::size_t count) {
            for (std::size_t k = first; k < first + count; ++k) {
                const std::array<double, freedoms> own = displacements(elements[k], u);
                std::array<double, freedoms> sum{};
                for (std::size_t j = 0; j < freedoms; ++j)  // K is symmetric
                    for (std::size_t i = 0; i < freedoms; ++i) sum[i] += stiffness_[j][i] * own[j];
                for (std::size_t i = 0; i < freedoms; ++i) result[3 * elements_[elements[k]][i / 3] + i % 3] += sum[i];
            }
        });
    for (std::size_t node = 0; node < nodes(); ++node)
        if (fixed_[node]) std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(3 * node), 3, 0);
}

double Elements::stress(std::size_t e, const Numbers& u) const {
    const std::array<double, freedoms> own = displacements(e, u);
    std::array<double, strains> strain{}, stress{};
    for (std::size_t r = 0; r < strains; ++r)
        for (std::size_t i = 0; i < freedoms; ++i) strain[r] += atCentre_[r][i] * own[i];
    for (std::size_t r = 0; r < strains; ++r)
        for (std::size_t s = 0; s < strains; ++s) stress[r] += elasticity_[r][s] * strain[s];
    return vonMises(stress);
}

/// The displacements in equilibrium; empty if there is none.
Numbers equilibrium(const Elements& elements) {
    const std::size_t size = elements.force().size();
    const Numbers& d = elements.diagonal();
    Numbers u(size, 0), residual = elements.force(), direction(size), product_(size), scaled(size);
    for (std::size_t i = 0; i < size; ++i) direction[i] = scaled[i] = residual[i] / d[i];
    double steepness = product(residual, scaled);
    const double small = smallestResidual * smallestResidual * product(residual, residual);
    const std::size_t limit = std::max(minimumIterations, iterationsPerNode * elements.nodes());
    for (std::size_t iteration = 0; iteration < limit; ++iteration) {
        if (product(residual, residual) <= small) return u;
        elements.multiply(direction, product_);
        const double step = steepness / product(direction, product_);
        if (!std::isfinite(step)) return {};
        for (std::size_t i = 0; i < size; ++i) {
            u[i] += step * direction[i];
            residual[i] -= step * product_[i];
            scaled[i] = residual[i] / d[i];
        }
        const double now = product(residual, scaled);
        for (std::size_t i = 0; i < size; ++i) direction[i] = scaled[i] + now / steepness * direction[i];
        steepness = now;
    }
    return {};
}

}  // namespace

std::vector<double> stressUnder(const ElasticLoad& load, const VoxelGrid& grid) {
    const Elements elements(grid, load);
    const Numbers u = equilibrium(elements);
    if (u.empty())
        throw InputError(
            load.where +
            "[load]: nothing holds the loaded voxels, expected a chain of voxels that share faces from box "
            "'at' to box 'held'");
    const double edge = static_cast<double>(grid.lattice().edgeMetres);
    std::vector<double> stresses(grid.active().size());
    for (std::size_t e = 0; e < stresses.size(); ++e) stresses[e] = elements.stress(e, u) / (edge * edge);
    return stresses;
}

void showStress(const ElasticLoad& load, VoxelGrid& grid) {
    const std::vector<double> stresses = stressUnder(load, grid);
    const double highest = std::ranges::max(stresses);
    const double full = load.fullPascals > 0 ? static_cast<double>(load.fullPascals) : highest;
    const auto mixed = [&](const PackedColour& own, double share) {
        const glm::vec4 colour = own.colour();
        return PackedColour(glm::vec4(glm::mix(glm::vec3(colour), load.colour, static_cast<float>(share)), colour.a));
    };
    for (std::size_t e = 0; e < stresses.size(); ++e) {
        Voxel& voxel = grid.voxels()[grid.active()[e]];
        const double share = full > 0 ? std::min(1.0, stresses[e] / full) : 0;
        voxel.colour = mixed(voxel.colour, share);
        voxel.fadingColour = mixed(voxel.fadingColour, share);
    }
}

}  // namespace dustbench::voxel_shape
