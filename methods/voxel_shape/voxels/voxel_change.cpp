#include "methods/voxel_shape/voxels/voxel_change.h"

#include <vector>

#include "methods/contract/errors.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

float distanceToSegment(const glm::vec3& point, const glm::vec3& begin, const glm::vec3& end) {
    const glm::vec3 along = end - begin;
    const float squared = glm::dot(along, along);
    const float t = squared > 0 ? glm::clamp(glm::dot(point - begin, along) / squared, 0.0f, 1.0f) : 0.0f;
    return glm::distance(point, begin + t * along);
}

}  // namespace

void VoxelChange::applyTo(Voxel& voxel, float voxelMetres) const {
    if (active) voxel.setActive(*active);
    const auto recolour = [](PackedColour& packed, const std::optional<glm::vec3>& rgb, const std::optional<float>& a) {
        const glm::vec4 old = packed.colour();
        packed = PackedColour(glm::vec4(rgb.value_or(glm::vec3(old)), a.value_or(old.a)));
    };
    if (colour || opacity) recolour(voxel.colour, colour, opacity);
    if (fadingColour || fadingOpacity) recolour(voxel.fadingColour, fadingColour, fadingOpacity);
    if (sizeVoxels) voxel.sizeMetres = *sizeVoxels * voxelMetres;
    if (fadingSizeVoxels) voxel.fadingSizeMetres = *fadingSizeVoxels * voxelMetres;
    if (lifetimeSeconds) voxel.lifetimeSeconds = *lifetimeSeconds;
    if (interpolationSeconds) voxel.interpolationSeconds = *interpolationSeconds;
    if (picturesPerSecond) voxel.picturesPerSecond = *picturesPerSecond;
    if (maximumDensity) voxel.maximumDensity = *maximumDensity;
    if (force) voxel.setForce(force->kind, force->vector, force->number);
}

bool VoxelChange::isEmpty() const {
    return !active && !colour && !fadingColour && !opacity && !fadingOpacity && !sizeVoxels && !fadingSizeVoxels &&
           !lifetimeSeconds && !interpolationSeconds && !picturesPerSecond && !maximumDensity && !force;
}

bool VoxelChange::contradictsItself() const {
    if (active.value_or(true)) return false;
    VoxelChange rest = *this;
    rest.active.reset();
    return !rest.isEmpty();
}

namespace {

/// Turns each inactive voxel for which `within` holds into a copy of the nearest active one, counted in steps through
/// faces. The copy stays inactive.
template <typename Within>
void giveNearestLooks(VoxelGrid& grid, const Within& within) {
    const Lattice& lattice = grid.lattice();
    std::vector<std::uint32_t> queue(grid.active().begin(), grid.active().end());
    std::vector<std::uint32_t> nearest(lattice.size(), nobody);
    for (const std::uint32_t i : queue) nearest[i] = i;
    for (std::size_t next = 0; next < queue.size(); ++next)
        for (int face = 0; face < 6; ++face) {
            glm::ivec3 cell = lattice.cell(queue[next]);
            cell[face / 2] += face % 2 == 0 ? -1 : 1;
            if (!lattice.contains(cell) || nearest[lattice.index(cell)] != nobody) continue;
            nearest[lattice.index(cell)] = nearest[queue[next]];
            queue.push_back(lattice.index(cell));
        }
    for (std::uint32_t i = 0; i < lattice.size(); ++i) {
        if (nearest[i] == nobody || grid.voxels()[i].isActive() || !within(lattice.centre(lattice.cell(i)))) continue;
        grid.voxels()[i] = grid.voxels()[nearest[i]];
        grid.voxels()[i].density = 0;
        grid.voxels()[i].setActive(false);
    }
}

}  // namespace

bool VoxelEdit::contains(const glm::vec3& point) const {
    if (region == Region::sphere) return distanceToSegment(point, centre, end) <= radiusMetres;
    if (region == Region::mesh) return mesh->contains(glm::dvec3(point));
    return glm::all(glm::lessThanEqual(minimum, point)) && glm::all(glm::lessThanEqual(point, maximum));
}

void VoxelEdit::applyTo(VoxelGrid& grid) const {
    const Lattice& lattice = grid.lattice();
    if (change.active.value_or(false)) giveNearestLooks(grid, [this](const glm::vec3& p) { return contains(p); });
    std::size_t met = 0;
    for (std::uint32_t i = 0; i < lattice.size(); ++i) {
        Voxel& voxel = grid.voxels()[i];
        if (!contains(lattice.centre(lattice.cell(i))) || !(voxel.isActive() || change.active.value_or(false)))
            continue;
        change.applyTo(voxel, lattice.edgeMetres);
        ++met;
    }
    if (met == 0) {
        const glm::vec3 low = lattice.origin, high = lattice.maximumCorner();
        const auto text = [](const glm::vec3& p) {
            return std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z);
        };
        throw InputError(where + "the edit contains no voxel of the shape, which extends from (" + text(low) +
                         ") to (" + text(high) + ")");
    }
    if (change.active) grid.listActive();
}

}  // namespace dustbench::voxel_shape
