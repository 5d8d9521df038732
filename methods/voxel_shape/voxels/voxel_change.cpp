#include "methods/voxel_shape/voxels/voxel_change.h"

#include "methods/contract/errors.h"

namespace dustbench::voxel_shape {

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

bool VoxelEdit::contains(const glm::vec3& point) const {
    if (region == Region::sphere) return glm::distance(point, centre) <= radiusMetres;
    if (region == Region::mesh) return mesh->contains(glm::dvec3(point));
    return glm::all(glm::lessThanEqual(minimum, point)) && glm::all(glm::lessThanEqual(point, maximum));
}

void VoxelEdit::applyTo(VoxelGrid& grid) const {
    const Lattice& lattice = grid.lattice();
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
        throw InputError(where + "the edit meets no voxel of the shape, which lies within (" + text(low) + ") to (" +
                         text(high) + ")");
    }
    if (change.active) grid.listActive();
}

}  // namespace dustbench::voxel_shape
