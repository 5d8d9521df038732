#include "bench/export/collected_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "methods/contract/volume.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::exports {
namespace {

constexpr double paddingDeviations = 4;

void grow(std::optional<Box>& bounds, const Box& box) {
    if (bounds)
        bounds->include(box);
    else
        bounds = box;
}

}  // namespace

void CollectedVolume::puffs(const Puffs& puffs) {
    if (!particles_) particles_ = std::make_unique<CollectedParticles>();
    CollectedParticles& particles = *particles_;
    if (++particles.calls == 2) particles.systems.assign(particles.all.size(), 1);
    if (particles.calls > 1) particles.systems.resize(particles.systems.size() + puffs.size(), particles.calls);
    particles.all.append(puffs);
    particles.source = puffs.serial.data();
    puffs_.reserve(puffs_.size() + puffs.size());
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        const CollectedPuff puff{puffs.position(i), puffs.radius[i], puffs.opacity[i]};
        const double mass =
            maths::puffMassSquareMetres(static_cast<double>(puff.opacity), static_cast<double>(puff.radiusMetres));
        for (const float number : {puff.centre.x, puff.centre.y, puff.centre.z, static_cast<float>(mass)})
            if (!std::isfinite(number))
                throw std::runtime_error(fmt::format(
                    "particle {}: position ({}, {}, {}), radius {} and opacity {} are not all finite numbers",
                    puffs.serial[i], puff.centre.x, puff.centre.y, puff.centre.z, puff.radiusMetres, puff.opacity));
        if (mass > 0) puffs_.push_back(puff);
    }
}

const CollectedParticles* CollectedVolume::particlesUnless(const Puffs& only) const {
    const bool isOnly = particles_ && particles_->calls == 1 && particles_->source == only.serial.data();
    return isOnly ? nullptr : particles_.get();
}

void CollectedVolume::octree(const OctreeVolume& volume) {
    for (const OctreeVoxel& voxel : volume.voxels) {
        const bool known = voxel.level >= 0 && voxel.level <= volume.depth && volume.depth < 31;
        const std::uint32_t cells = known ? 1u << voxel.level : 0;
        if (voxel.x >= cells || voxel.y >= cells || voxel.z >= cells || !std::isfinite(voxel.extinctionPerMetre))
            throw std::runtime_error(fmt::format(
                "octree voxel ({}, {}, {}) of level {}, extinction {}: is outside a tree of depth {}, or its "
                "extinction is not a finite number",
                voxel.x, voxel.y, voxel.z, voxel.level, voxel.extinctionPerMetre, volume.depth));
    }
    octrees_.push_back({volume.originMetres, volume.edgeMetres, volume.depth, {}});
    octrees_.back().voxels.assign(volume.voxels.begin(), volume.voxels.end());
}

void CollectedVolume::grid(const GridVolume& volume) {
    const std::size_t count = static_cast<std::size_t>(volume.cells.x) * static_cast<std::size_t>(volume.cells.y) *
                              static_cast<std::size_t>(volume.cells.z);
    const auto take = [&](std::string_view name, std::size_t components, std::span<const float> values) {
        if (values.size() != count * components)
            throw std::runtime_error(fmt::format("grid of {}x{}x{} cells: field {} has {} numbers, expected {}",
                                                 volume.cells.x, volume.cells.y, volume.cells.z, name, values.size(),
                                                 count * components));
        for (std::size_t n = 0; n < values.size(); ++n)
            if (!std::isfinite(values[n]))
                throw std::runtime_error(
                    fmt::format("grid: the {} of cell {} is not a finite number", name, n / components));
        return std::vector<float>(values.begin(), values.end());
    };
    CollectedGrid grid{
        volume.originMetres, volume.spacingMetres, volume.cells, take("extinction", 1, volume.extinctionPerMetre), {}};
    for (const GridField& field : volume.fields)
        grid.fields.push_back({std::string(field.name), std::string(field.unit), field.components,
                               take(field.name, static_cast<std::size_t>(field.components), field.values)});
    grids_.push_back(std::move(grid));
}

void CollectedVolume::surface(const SurfaceVolume& volume) {
    const std::size_t count = static_cast<std::size_t>(volume.columns) * static_cast<std::size_t>(volume.rows);
    const auto require = [&](std::string_view name, std::size_t components, std::span<const float> values) {
        if (values.size() != count * components)
            throw std::runtime_error(fmt::format("surface {} of {}x{} points: {} has {} numbers, expected {}",
                                                 volume.name, volume.columns, volume.rows, name, values.size(),
                                                 count * components));
        for (std::size_t n = 0; n < values.size(); ++n)
            if (!std::isfinite(values[n]))
                throw std::runtime_error(fmt::format("surface {}: the {} of point {} is not a finite number",
                                                     volume.name, name, n / components));
    };
    const auto numbersOf = [](std::span<const glm::vec3> vectors) {
        return std::span<const float>(reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size());
    };
    require("position", 3, numbersOf(volume.position));
    require("colour", 3, numbersOf(volume.colour));
    require("height", 1, volume.height);
    CollectedSurface surface{std::string(volume.name),
                             volume.columns,
                             volume.rows,
                             {volume.position.begin(), volume.position.end()},
                             {volume.colour.begin(), volume.colour.end()},
                             {volume.height.begin(), volume.height.end()},
                             {}};
    for (const GridField& field : volume.fields) {
        require(field.name, static_cast<std::size_t>(field.components), field.values);
        surface.fields.push_back({std::string(field.name), std::string(field.unit), field.components,
                                  std::vector<float>(field.values.begin(), field.values.end())});
    }
    surfaces_.push_back(std::move(surface));
}

void CollectedVolume::texture(const StateTexture& texture) {
    const std::size_t count = static_cast<std::size_t>(texture.columns) * static_cast<std::size_t>(texture.rows);
    if (texture.texels.size() != count)
        throw std::runtime_error(fmt::format("texture {} of {}x{} texels: has {}, expected {}", texture.name,
                                             texture.columns, texture.rows, texture.texels.size(), count));
    for (std::size_t i = 0; i < count; ++i)
        for (int channel = 0; channel < 4; ++channel)
            if (!std::isfinite(texture.texels[i][channel]))
                throw std::runtime_error(
                    fmt::format("texture {}: channel {} of texel {} is not a finite number", texture.name, channel, i));
    textures_.push_back(
        {std::string(texture.name), texture.columns, texture.rows, {texture.texels.begin(), texture.texels.end()}});
}

namespace {

/// Bounding box of all cells of a grid with extinction.
std::optional<Box> boundsOf(const CollectedGrid& grid) {
    glm::ivec3 minimum(grid.cells), maximum(-1);
    for (int k = 0; k < grid.cells.z; ++k)
        for (int j = 0; j < grid.cells.y; ++j)
            for (int i = 0; i < grid.cells.x; ++i) {
                if (grid.extinctionPerMetre[grid.row(j, k) + static_cast<std::size_t>(i)] == 0) continue;
                minimum = glm::min(minimum, glm::ivec3(i, j, k));
                maximum = glm::max(maximum, glm::ivec3(i, j, k));
            }
    if (maximum.x < 0) return std::nullopt;
    return Box{grid.originMetres + glm::dvec3(minimum) * grid.spacingMetres,
               grid.originMetres + glm::dvec3(maximum + 1) * grid.spacingMetres};
}

}  // namespace

std::optional<Box> CollectedVolume::bounds() const {
    std::optional<Box> bounds;
    for (const CollectedGrid& grid : grids_)
        if (const auto box = boundsOf(grid)) grow(bounds, *box);
    for (const CollectedPuff& puff : puffs_) {
        const glm::dvec3 centre(puff.centre);
        const double reach = paddingDeviations * maths::puffDeviationMetres(static_cast<double>(puff.radiusMetres));
        grow(bounds, {centre - reach, centre + reach});
    }
    for (const CollectedOctree& octree : octrees_)
        for (const OctreeVoxel& voxel : octree.voxels) {
            if (voxel.extinctionPerMetre == 0) continue;
            const glm::dvec3 corner = octree.minimumCorner(voxel);
            grow(bounds, {corner, corner + octree.cellEdgeMetres(voxel.level)});
        }
    return bounds;
}

}  // namespace dustbench::exports
