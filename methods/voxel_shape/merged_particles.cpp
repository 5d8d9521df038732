#include "methods/voxel_shape/merged_particles.h"

#include <algorithm>

namespace dustbench::voxel_shape {

const ShapeParticles& MergedParticles::of(std::span<LivingShape> shapes) {
    if (shapes.size() == 1) return shapes.front().system().particles();
    std::size_t count = 0;
    for (const LivingShape& shape : shapes) count += shape.system().particles().size();
    all_.resize(count);
    std::size_t first = 0;
    for (const LivingShape& shape : shapes) {
        const ShapeParticles& own = shape.system().particles();
        const auto copy = [&](const auto& from, auto& to) {
            std::ranges::copy(from, to.begin() + static_cast<std::ptrdiff_t>(first));
        };
        using Store = particles::ParticleStore;
        for (const auto column :
             {&Store::x, &Store::y, &Store::z, &Store::velocityX, &Store::velocityY, &Store::velocityZ, &Store::radius,
              &Store::opacity, &Store::red, &Store::green, &Store::blue})
            copy(own.store.*column, all_.store.*column);
        copy(own.picture, all_.picture);
        first += own.size();
    }
    return all_;
}

}  // namespace dustbench::voxel_shape
