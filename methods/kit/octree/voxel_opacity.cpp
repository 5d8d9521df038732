#include "methods/kit/octree/voxel_opacity.h"

#include "methods/kit/octree/particle_place.h"

namespace dustbench::octree {

Puffs VoxelOpacity::of(const Puffs& dust, const Lattice& lattice, const OctreeSettings& settings) {
    const ParticlePlace place(dust, lattice, settings);
    radii_.resize(dust.size());
    for (std::size_t i = 0; i < dust.size(); ++i)
        radii_[i] = static_cast<float>(lattice.cellEdgeMetres(place.level(i))) / edgePerRadius;
    Puffs shown = dust;
    shown.opacity = opacities_.of(dust);
    shown.radius = radii_;
    return shown;
}

}  // namespace dustbench::octree
