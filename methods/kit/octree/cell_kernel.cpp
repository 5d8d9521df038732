#include "methods/kit/octree/cell_kernel.h"

#include <cmath>
#include <string>

#include "methods/contract/errors.h"
#include "methods/contract/volume.h"
#include "methods/kit/octree/octree.h"

namespace dustbench::octree {

bool isNumber(const Puffs& store, std::size_t particle) {
    return !(std::isnan(store.x[particle]) || std::isnan(store.y[particle]) || std::isnan(store.z[particle]));
}

void checkPositions(const Puffs& store) {
    // Checks all positions without branches first, because NaN is rare.
    const float *x = store.x.data(), *y = store.y.data(), *z = store.z.data();
    std::uint32_t bad = 0;
    for (std::size_t i = 0; i < store.size(); ++i) bad |= std::isnan(x[i]) || std::isnan(y[i]) || std::isnan(z[i]);
    if (bad == 0) return;
    for (std::size_t i = 0; i < store.size(); ++i)
        if (!isNumber(store, i))
            throw SimulationError("octree: the position of the particle with serial " +
                                  std::to_string(store.serial[i]) + " is not a number");
}

void checkCount(const Puffs& store) {
    if (store.size() > CellEntry::maximumIndex)
        throw InputError("octree: got " + std::to_string(store.size()) + " particles, allowed: up to " +
                         std::to_string(CellEntry::maximumIndex));
}

}  // namespace dustbench::octree
