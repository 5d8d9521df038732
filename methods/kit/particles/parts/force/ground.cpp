// The ground supports particles and slows those that touch it.
//
// A centre stays at least `lift`·radius above the ground below it (a puff is soft and may sink in). A particle that
// would move lower is raised to that height and loses its velocity into the ground, v ← v − (v·n)n if v·n < 0; the rest
// decays at the rate `friction` (implicitly: v ← v/(1 + k·dt)). Departs from its source, the contact forces: position
// and velocity are corrected after the move.
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::force::ground {
namespace {

/// The surface below each particle of a chunk: height and slopes, n ∝ (−∂h/∂x, 1, −∂h/∂z).
struct Surface {
    alignas(64) float height[chunkSize], slopeX[chunkSize], slopeZ[chunkSize];
};

/// The height field, prepared for the loop.
struct Field {
    const float* heights;
    int columns;
    float originX, originZ, spacing, lastColumn, lastRow;
};

float minimum(float a, float b) {
    return a < b ? a : b;
}
float maximum(float a, float b) {
    return a > b ? a : b;
}

/// Evaluates scene::Terrain's bilinear surface, in the same order of operations.
void surfaceBelow(std::size_t count, const float* __restrict x, const float* __restrict z, float* __restrict height,
                  float* __restrict slopeX, float* __restrict slopeZ, const Field field) {
    const float* __restrict heights = field.heights;
    const float perSpacing = 1.0f / field.spacing;
    for (std::size_t i = 0; i < count; ++i) {
        const float gridX = (x[i] - field.originX) / field.spacing, gridZ = (z[i] - field.originZ) / field.spacing;
        const float heldX = minimum(maximum(gridX, 0.0f), field.lastColumn),
                    heldZ = minimum(maximum(gridZ, 0.0f), field.lastRow);
        // The last sample belongs to the cell before it.
        const int column = static_cast<int>(minimum(heldX, field.lastColumn - 1.0f));
        const int row = static_cast<int>(minimum(heldZ, field.lastRow - 1.0f));
        const float u = heldX - static_cast<float>(column), v = heldZ - static_cast<float>(row);

        const int at = row * field.columns + column;
        const float h00 = heights[at], h10 = heights[at + 1];
        const float h01 = heights[at + field.columns], h11 = heights[at + field.columns + 1];
        const float near = h00 + u * (h10 - h00), far = h01 + u * (h11 - h01);
        const float alongX = (h10 - h00) * (1.0f - v) + (h11 - h01) * v;
        height[i] = near + v * (far - near);
        // Beyond the edge, the surface continues level.
        slopeX[i] = alongX * (heldX == gridX ? perSpacing : 0.0f);
        slopeZ[i] = (far - near) * (heldZ == gridZ ? perSpacing : 0.0f);
    }
}

void touchPlane(std::size_t count, const float* __restrict radius, float* __restrict y, float* __restrict velocityX,
                float* __restrict velocityY, float* __restrict velocityZ, float lift, float kept) {
    for (std::size_t i = 0; i < count; ++i) {
        const float floor = lift * radius[i];
        const bool below = y[i] < floor;
        const float share = below ? kept : 1.0f;
        const float slowest = below ? 0.0f : velocityY[i];
        y[i] = below ? floor : y[i];
        velocityX[i] *= share;
        velocityY[i] = share * maximum(velocityY[i], slowest);
        velocityZ[i] *= share;
    }
}

void touchSurface(std::size_t count, const float* __restrict radius, float* __restrict y, float* __restrict velocityX,
                  float* __restrict velocityY, float* __restrict velocityZ, const float* __restrict height,
                  const float* __restrict slopeX, const float* __restrict slopeZ, float lift, float kept) {
    for (std::size_t i = 0; i < count; ++i) {
        const float floor = height[i] + lift * radius[i];
        const bool below = y[i] < floor;
        const float share = below ? kept : 1.0f;
        const float weight = below ? 1.0f : 0.0f;
        const float into = velocityY[i] - slopeX[i] * velocityX[i] - slopeZ[i] * velocityZ[i];  // v·n·|n|
        const float taken = weight * minimum(into, 0.0f) / (1.0f + slopeX[i] * slopeX[i] + slopeZ[i] * slopeZ[i]);
        y[i] = below ? floor : y[i];
        velocityX[i] = share * (velocityX[i] + taken * slopeX[i]);
        velocityY[i] = share * (velocityY[i] - taken);
        velocityZ[i] = share * (velocityZ[i] + taken * slopeZ[i]);
    }
}

class Ground final : public ForcePart {
 public:
    explicit Ground(const ParameterValues& values);

    void touch(Chunk& chunk, const Step& step) const override;

 private:
    float lift_;
    double frictionPerSecond_;
};

Ground::Ground(const ParameterValues& values)
    : ForcePart(values),
      lift_(static_cast<float>(values.real("lift"))),
      frictionPerSecond_(values.real("friction_per_second")) {}

void Ground::touch(Chunk& chunk, const Step& step) const {
    const float kept = static_cast<float>(1 / (1 + frictionPerSecond_ * step.seconds));
    const scene::Terrain& terrain = step.scene.terrain;
    if (terrain.isFlat()) {
        touchPlane(chunk.count, chunk.radius, chunk.y, chunk.velocityX, chunk.velocityY, chunk.velocityZ, lift_, kept);
        return;
    }
    const Field field{terrain.heights().data(),
                      terrain.columns(),
                      terrain.origin().x,
                      terrain.origin().y,
                      terrain.spacingMetres(),
                      static_cast<float>(terrain.columns() - 1),
                      static_cast<float>(terrain.rows() - 1)};
    Surface surface;
    surfaceBelow(chunk.count, chunk.x, chunk.z, surface.height, surface.slopeX, surface.slopeZ, field);
    touchSurface(chunk.count, chunk.radius, chunk.y, chunk.velocityX, chunk.velocityY, chunk.velocityZ, surface.height,
                 surface.slopeX, surface.slopeZ, lift_, kept);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "the ground supports particles and slows them";
    info.source = "Thesis, 5.3";
    info.parameters.real("lift", 0.3, 0, 10, "", "minimum height of a centre above the ground, in radii")
        .real("friction_per_second", 2, 0, 1e6, "1/s", "rate at which particles on the ground come to rest");
    info.create = [](const ParameterValues& values) { return std::make_unique<Ground>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::ground
