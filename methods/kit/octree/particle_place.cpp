#include "methods/kit/octree/particle_place.h"

namespace dustbench::octree {

std::int64_t listActive(const Puffs& store, const ParticlePlace& place, LedgerVector<std::uint32_t>& active) {
    checkCount(store);
    active.clear();
    for (std::uint32_t i = 0; i < store.size(); ++i)
        if (place.isInside(i)) active.push_back(i);
    const auto clipped = static_cast<std::int64_t>(store.size() - active.size());
    if (clipped > 0) checkPositions(store);
    return clipped;
}

}  // namespace dustbench::octree
