// The particles within one relief: they move, age and collide with its surface.
//
// A particle lives from its entry through the face until it hits the surface, leaves the plate or reaches its maximum
// age. The columns are those of the paper's two textures: position and age, and velocity. They are moved on the CPU, or
// by a shader (particles_gl/texture_mover.h).
//
// Units: m, m/s, s; ages in steps. Frame: that of the panel's relief (kit/meshes/curved_panel.h). Owns: its columns,
// booked on a ledger. Threads: `step` uses the current oneTBB arena; results do not depend on the number of threads.
// Source: Bergeron, 3.1 to 3.3.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/relief/surface/depth_map.h"

namespace dustbench::relief {

/// The motion of a particle during one step:
///
/// paper:  P ← P₀ + V₀·T + ½·g·T²,  V ← V₀·T + g·T,  T the age in steps times Δt; V₀ per step
/// fixed:  P ← P₀ + V₀·Δt + ½·g·Δt²,  V ← V₀ + g·Δt
///
/// In the paper T is the age, which increases by one per step, and P₀ and V₀ are rewritten in each step. With one step
/// as the unit of time the first step is right; afterwards displacement and velocity compound. In SI units, with n the
/// age in steps: P ← P₀ + V₀·nΔt + ½·g·(nΔt)² and V ← n·(V₀ + g·Δt).
enum class MotionLaw { paper, fixed };
inline constexpr Choices<MotionLaw> motionLaws{{"paper", MotionLaw::paper}, {"fixed", MotionLaw::fixed}};

struct Motion {
    glm::vec3 place, velocity;
};

/// `ageSteps` includes the current step: 1 in a particle's first step.
[[nodiscard]] inline Motion moved(MotionLaw law, const Motion& old, const glm::vec3& gravity, float ageSteps,
                                  float stepSeconds) {
    if (law == MotionLaw::fixed)
        return {old.place + old.velocity * stepSeconds + gravity * (0.5f * stepSeconds * stepSeconds),
                old.velocity + gravity * stepSeconds};
    const float t = ageSteps * stepSeconds;
    return {old.place + old.velocity * t + gravity * (0.5f * t * t), (old.velocity + gravity * stepSeconds) * ageSteps};
}

/// From the frame of a panel's relief to its (u, v, depth).
class TexelFrame {
 public:
    explicit TexelFrame(const scene::Panel& panel);

    [[nodiscard]] glm::dvec3 toTexels(const glm::dvec3& place) const { return place * scale_ + offset_; }
    [[nodiscard]] glm::dvec3 toMetres(const glm::dvec3& texels) const { return (texels - offset_) / scale_; }
    /// Unit normal of the surface, in the frame of the relief, for its slope in texels.
    [[nodiscard]] glm::dvec3 normal(const glm::dvec2& slope) const;
    [[nodiscard]] double texelAreaSquareMetres() const { return 1 / (scale_.x * scale_.y); }
    [[nodiscard]] double texelsPerMetre() const { return scale_.x; }

 private:
    glm::dvec3 scale_, offset_;
};

struct ParticleLook {
    float radius = 0, opacity = 0;
};

/// The end of a particle on the surface.
struct SurfaceHit {
    glm::vec3 texels;    ///< u, v, depth
    glm::vec3 velocity;  ///< m/s
    glm::vec3 normal;    ///< of the surface, unit
    ParticleLook look;
    std::uint64_t serial;
};

struct StepSettings {
    MotionLaw law = MotionLaw::fixed;
    glm::vec3 gravity{0, -9.8f, 0};  ///< m/s², in the panel's frame
    float stepSeconds = 1.0f / 60;
    float maximumAgeSteps = 600;
    /// Pyramid of the current surface; null: each particle is collided patch by patch, with the same result.
    const DepthPyramid* pyramid = nullptr;
};

enum class Fate : std::uint8_t { lives, hit, gone };

/// Data that a step changes, one entry per particle. A particle that hits ends at its hit; its velocity is that at the
/// end of the step.
struct MovingColumns {
    std::span<glm::vec4> places;      ///< w: age in steps
    std::span<glm::vec4> velocities;  ///< w: not used
    std::span<Fate> fates;            ///< output only
};

/// Moves particles by one step, collides them and determines the fate of each.
class Mover {
 public:
    virtual ~Mover() = default;
    /// The columns contain the particles alive after the last call, in order, followed by the newborn ones.
    virtual void move(const MovingColumns& columns, const DepthMap& surface, const StepSettings& settings) = 0;
};

/// The CPU mover, which is the reference implementation. A curved panel's particles move in the panel's frame: their
/// paths in the frame of the relief are then curves, of which each step is a chord.
class ArrayMover final : public Mover {
 public:
    /// `panel` must outlive this.
    explicit ArrayMover(const scene::Panel& panel);
    void move(const MovingColumns& columns, const DepthMap& surface, const StepSettings& settings) override;

 private:
    [[nodiscard]] Motion movedInRelief(const Motion& old, float ageSteps, const StepSettings& settings) const;
    [[nodiscard]] float openAbove(const StepSettings& settings) const;
    [[nodiscard]] bool staysAbove(const glm::vec3& from, const glm::vec3& to, const DepthPyramid& pyramid) const;
    [[nodiscard]] Fate advance(glm::vec4& place, glm::vec4& velocity, const DepthMap& surface,
                               const StepSettings& settings) const;

    const scene::Panel* panel_;
    glm::dvec2 halfSize_;
    TexelFrame texels_;
    glm::vec2 within_;                    ///< slightly less than half the size, for rounding
    glm::vec3 patchScale_, patchOffset_;  ///< from metres to patches and depth
};

class ReliefParticles {
 public:
    ReliefParticles(const scene::Panel& panel, MemoryLedger& ledger);

    /// Adds a newborn at its entry; it moves from the next step on.
    void add(const Motion& motion, const ParticleLook& look, std::uint64_t serial);
    /// Moves all particles, collides each along its whole path and removes those that ended. Hits are in the order of
    /// the particles.
    void step(const DepthMap& surface, const StepSettings& settings) { step(arrays_, surface, settings); }
    /// The same by another mover: always the same one from the first step on.
    void step(Mover& mover, const DepthMap& surface, const StepSettings& settings);

    [[nodiscard]] std::span<const SurfaceHit> hits() const { return hits_; }  ///< of the last step
    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] std::span<const glm::vec4> places() const { return places_; }          ///< w: age in steps
    [[nodiscard]] std::span<const glm::vec4> velocities() const { return velocities_; }  ///< w: not used
    [[nodiscard]] std::span<const ParticleLook> looks() const { return looks_; }
    [[nodiscard]] std::span<const std::uint64_t> serials() const { return serials_; }
    [[nodiscard]] const TexelFrame& texels() const { return texels_; }

 private:
    void settle(const DepthMap& surface);

    TexelFrame texels_;
    ArrayMover arrays_;
    LedgerVector<glm::vec4> places_, velocities_;
    LedgerVector<ParticleLook> looks_;
    LedgerVector<std::uint64_t> serials_;
    LedgerVector<Fate> fates_;
    LedgerVector<SurfaceHit> hits_;
};

}  // namespace dustbench::relief
