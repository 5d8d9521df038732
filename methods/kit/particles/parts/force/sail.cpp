// The pressure of moving air on a surface: a = ½·ρ·|w|·w/σ·n, with w = n·(u − v).
//
// n: the normal of the lattice's sheet at the particle, σ: the mass of a square metre. Air along the surface does
// nothing. The step takes w to its exact value after Δt, so that light cloth in a gale stays stable.
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles::parts::force::sail {
namespace {

class Sail final : public ForcePart {
 public:
    explicit Sail(const ParameterValues& values)
        : ForcePart(values),
          perMetre_(static_cast<float>(0.5 * values.real("air_density") / values.real("area_density"))) {}

    [[nodiscard]] bool needsLattice() const override { return true; }
    /// Throws InputError if the lattice has more than one layer.
    void begin(const Step& step, const ParticleStore& store) override;
    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::size_t bytes() const override {
        return surface_.bytes() + normals_.capacity() * sizeof(glm::vec3);
    }

 private:
    float perMetre_;  ///< ½·ρ/σ
    LatticeSurface surface_;
    std::vector<glm::vec3> normals_;  ///< of this step, in the store's order
};

void Sail::begin(const Step& step, const ParticleStore& store) {
    if (step.lattice->points.z > 1)
        throw InputError("force sail: got a lattice of " + std::to_string(step.lattice->points.z) +
                         " layers, allowed: 1");
    surface_.follow(*step.lattice, store.serial);
    normals_.resize(store.size());
    const auto vertices = surface_.vertices();
    parallel::forEachBlock(vertices.size(), 1024, [&](std::size_t first, std::size_t count) {
        for (const auto& v : vertices.subspan(first, count))
            normals_[v.particle] = LatticeSurface::normalOf(v, [&](std::uint32_t i) { return store.position(i); });
    });
}

/// dw/dt = −r·|w|·w, r = ½·ρ/σ: w(Δt) = w/(1 + r·|w|·Δt).
void Sail::push(Chunk& chunk, const Step& step) const {
    const auto seconds = static_cast<float>(step.seconds);
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3& n = normals_[chunk.first + i];
        const float w = n.x * (chunk.airX[i] - chunk.velocityX[i]) + n.y * (chunk.airY[i] - chunk.velocityY[i]) +
                        n.z * (chunk.airZ[i] - chunk.velocityZ[i]);
        const float rate = perMetre_ * std::abs(w);
        const float a = rate * w / (1 + rate * seconds);
        chunk.accelerationX[i] += a * n.x;
        chunk.accelerationY[i] += a * n.y;
        chunk.accelerationZ[i] += a * n.z;
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "pressure of the air, such as that of `wind`, on a lattice of one layer";
    info.source = "Provot1995, 3";
    info.parameters.real("air_density", 1.2, 0, 100, "kg/m³", "ρ of the air")
        .real("area_density", 0.2, 1e-3, 1000, "kg/m²", "σ of the surface");
    info.create = [](const ParameterValues& values) { return std::make_unique<Sail>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::sail
