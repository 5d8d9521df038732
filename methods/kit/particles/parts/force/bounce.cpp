// Particles bounce on a surface: v ← (1 − friction)·v∥ − restitution·v⊥, relative to the surface where it moves.
//
// fixed: the path of each step is tested as a segment, at any speed; the particle bounces at the point of contact
// (contacts.h). With restitution 1 and no friction it keeps its energy and retraces its path.
// paper: tests positions, the current one x and the predicted one x + v·dt. If the surface lies between them, v is
// mirrored and scaled by the restitution, at the current position, as if the surface did not move. On a disc:
// d(x)·d(x + v·dt) < error, then |x − centre| < radius. So a fast particle misses it, and one that leaves it slowly is
// caught.
#include <cmath>

#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/surface_shapes.h"

namespace dustbench::particles::parts::force::bounce {
namespace {

/// v ← restitution·(v − 2(v·n)n) if `meets`.
struct Mirror {
    float restitution;

    void operator()(float& vx, float& vy, float& vz, float nx, float ny, float nz, bool meets) const {
        const float twice = meets ? 2.0f * (vx * nx + vy * ny + vz * nz) : 0.0f, kept = meets ? restitution : 1.0f;
        vx = kept * (vx - twice * nx);
        vy = kept * (vy - twice * ny);
        vz = kept * (vz - twice * nz);
    }
};

void mirrorAtPlane(std::size_t count, const float* __restrict x, const float* __restrict y, const float* __restrict z,
                   float* __restrict vx, float* __restrict vy, float* __restrict vz, const SurfaceNumbers s,
                   const Mirror mirror, float dt) {
    const glm::vec3 n = s.normal, p = s.place;
    for (std::size_t i = 0; i < count; ++i) {
        const float now = n.x * (x[i] - p.x) + n.y * (y[i] - p.y) + n.z * (z[i] - p.z);
        const float speed = n.x * vx[i] + n.y * vy[i] + n.z * vz[i];
        const bool meets = ((now <= 0.0f) | (now + speed * dt <= 0.0f)) & (speed < 0.0f);
        mirror(vx[i], vy[i], vz[i], n.x, n.y, n.z, meets);
    }
}

void mirrorAtSphere(std::size_t count, const float* __restrict x, const float* __restrict y, const float* __restrict z,
                    float* __restrict vx, float* __restrict vy, float* __restrict vz, const SurfaceNumbers s,
                    const Mirror mirror, float dt) {
    const float squared = s.radiusMetres * s.radiusMetres;
    for (std::size_t i = 0; i < count; ++i) {
        const float ox = x[i] - s.place.x, oy = y[i] - s.place.y, oz = z[i] - s.place.z;
        const float nextX = ox + vx[i] * dt, nextY = oy + vy[i] * dt, nextZ = oz + vz[i] * dt;
        const float now = ox * ox + oy * oy + oz * oz, next = nextX * nextX + nextY * nextY + nextZ * nextZ;
        const float outwards = ox * vx[i] + oy * vy[i] + oz * vz[i];
        const float perLength = 1.0f / std::sqrt(now > 1e-20f ? now : 1e-20f);
        const bool meets = ((now < squared) | (next < squared)) & (outwards < 0.0f);
        mirror(vx[i], vy[i], vz[i], ox * perLength, oy * perLength, oz * perLength, meets);
    }
}

void mirrorAtDisc(std::size_t count, const float* __restrict x, const float* __restrict y, const float* __restrict z,
                  float* __restrict vx, float* __restrict vy, float* __restrict vz, const SurfaceNumbers s,
                  const Mirror mirror, float dt, float error) {
    const glm::vec3 n = s.normal, c = s.place;
    const float squared = s.radiusMetres * s.radiusMetres;
    for (std::size_t i = 0; i < count; ++i) {
        const float ox = x[i] - c.x, oy = y[i] - c.y, oz = z[i] - c.z;
        const float now = n.x * ox + n.y * oy + n.z * oz;
        const float next = now + (n.x * vx[i] + n.y * vy[i] + n.z * vz[i]) * dt;
        const bool meets = (now * next < error) & (ox * ox + oy * oy + oz * oz < squared);
        mirror(vx[i], vy[i], vz[i], n.x, n.y, n.z, meets);
    }
}

void mirrorAtMesh(const Chunk& chunk, const Surface& surface, const Mirror mirror, float dt) {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        float &vx = chunk.velocityX[i], &vy = chunk.velocityY[i], &vz = chunk.velocityZ[i];
        const glm::vec3 from(chunk.x[i], chunk.y[i], chunk.z[i]), to = from + dt * glm::vec3(vx, vy, vz);
        float share;
        surface.meet({1, &from.x, &from.y, &from.z, &to.x, &to.y, &to.z, &dt}, &share);
        if (share > 1) continue;
        const glm::vec3 n = surface.touchAt({from, to, dt, share}).normal;
        mirror(vx, vy, vz, n.x, n.y, n.z, true);
    }
}

class Bounce final : public ForcePart {
 public:
    /// Throws InputError if the surface cannot be used.
    explicit Bounce(const ParameterValues& values);

    void begin(const Step& step, const ParticleStore&) override { surface_->begin(step); }
    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] const Surface* surface() const override { return printed_ ? nullptr : surface_.get(); }
    [[nodiscard]] Contact contact() const override { return contact_; }
    [[nodiscard]] std::optional<Mark> mark() const override { return markOfSurface(values()); }
    [[nodiscard]] std::size_t bytes() const override { return surface_->bytes(); }

 private:
    bool printed_;
    SurfaceNumbers numbers_;
    std::unique_ptr<Surface> surface_;
    Contact contact_;
    float error_;
};

Bounce::Bounce(const ParameterValues& values)
    : ForcePart(values),
      printed_(values.choice("mode", samplingModes) == maths::SamplingMode::paper),
      numbers_(surfaceNumbers(values)),
      surface_(makeSurface(values)),
      contact_{static_cast<float>(values.real("restitution")), static_cast<float>(values.real("friction"))},
      error_(static_cast<float>(values.real("error"))) {}

void Bounce::push(Chunk& chunk, const Step& step) const {
    if (!printed_) return;
    const Mirror mirror{contact_.restitution};
    const float dt = static_cast<float>(step.seconds);
    const Chunk& c = chunk;
    switch (numbers_.shape) {
        case SurfaceShape::halfSpace:
            return mirrorAtPlane(c.count, c.x, c.y, c.z, c.velocityX, c.velocityY, c.velocityZ, numbers_, mirror, dt);
        case SurfaceShape::sphere:
            return mirrorAtSphere(c.count, c.x, c.y, c.z, c.velocityX, c.velocityY, c.velocityZ, numbers_, mirror, dt);
        case SurfaceShape::disc:
            return mirrorAtDisc(c.count, c.x, c.y, c.z, c.velocityX, c.velocityY, c.velocityZ, numbers_, mirror, dt,
                                error_);
        case SurfaceShape::mesh:
        case SurfaceShape::scene:
            return mirrorAtMesh(c, *surface_, mirror, dt);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help =
        "particles bounce on a half-space, a sphere, a disc, a mesh, or on the scene's ground, solids and vehicle; at "
        "restitution 0 and friction 1 they stick";
    info.source = "Thesis, 5.3 and 6.1";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: tests the current and the predicted position, mirrors at the current one; fixed: "
                           "tests the path between them, bounces where it hits the surface");
    declareSurface(info.parameters);
    info.parameters
        .real("restitution", 0.6, 0, 1, "",
              "share of the speed into the surface that is kept; in mode paper "
              "of the whole speed")
        .real("friction", 0, 0, 1, "", "share of the speed along the surface that is lost; in mode fixed")
        .real("error", 1e-3, 0, 100, "m²", "the disc's margin in mode paper: d(x)·d(x + v·dt) below it is a contact");
    info.create = [](const ParameterValues& values) { return std::make_unique<Bounce>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::bounce
