#include "methods/shared/octree/cell_kernel.h"

#include <cmath>
#include <string>

#include "methods/shared/errors.h"
#include "methods/shared/octree/cell_entry.h"
#include "methods/shared/simulation_error.h"

namespace dustbench::octree {

bool isNumber(const particles::ParticleStore& store, std::size_t particle) {
    return !(std::isnan(store.x[particle]) || std::isnan(store.y[particle]) || std::isnan(store.z[particle]));
}

void checkPositions(const particles::ParticleStore& store) {
    // All of them first, without a branch: what is not a number is rare.
    const float *x = store.x.data(), *y = store.y.data(), *z = store.z.data();
    std::uint32_t bad = 0;
    for (std::size_t i = 0; i < store.size(); ++i) bad |= std::isnan(x[i]) || std::isnan(y[i]) || std::isnan(z[i]);
    if (bad == 0) return;
    for (std::size_t i = 0; i < store.size(); ++i)
        if (!isNumber(store, i))
            throw SimulationError("octree: the position of the particle with serial " +
                                  std::to_string(store.serial[i]) + " is not a number");
}

void checkCount(const particles::ParticleStore& store) {
    if (store.size() > CellEntry::maximumIndex)
        throw InputError("octree: got " + std::to_string(store.size()) + " particles, allowed: up to " +
                         std::to_string(CellEntry::maximumIndex));
}

}  // namespace dustbench::octree
