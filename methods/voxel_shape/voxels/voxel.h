// One voxel of a shape: how the particles in it look and move. 64 bytes, one line of the cache, because whoever looks
// a voxel up wants nearly all of it.
//
// Units: m, s, linear RGB. Frame: the shape's own.
// Source: JuckelBeckhaus2007, 4.2 (the attributes). Departs: opacity as the colours' fourth channel; see Force.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace dustbench::voxel_shape {

/// The paper names four kinds and gives no formulas. With ω the force's vector, r the particle's place from the voxel's
/// centre, c = ω × (ω × r) and k the second number:
///     linear   acceleration ω, the same in the whole voxel (m/s²)
///     orbit    acceleration −|ω|²·r: the centre attracts; ω is the axis of the orbits in which particles are born
///     gravity  the same for particles that are born at rest: they fall through the centre and back
///     spiral   velocity ω × r − k/|ω|·c: round the axis, r⊥ growing by the factor e^k a radian
///     helix    velocity ω × r + k·ω: round the axis and on along it, k metres a radian
/// A spiral or helix turns with acceleration c and draws the particle's velocity, relative to the shape's, to its own.
/// Each is applied over a step as the straight push it is at the step's beginning.
enum class Force : std::uint32_t { linear, orbit, spiral, helix, gravity };

/// Four numbers 0..1 in eight bytes, to the nearest of 65536 steps.
struct PackedColour {
    std::uint32_t redGreen = 0, blueOpacity = 0;

    PackedColour() = default;
    explicit PackedColour(const glm::vec4& colour)
        : redGreen(pair(colour.r, colour.g)), blueOpacity(pair(colour.b, colour.a)) {}
    [[nodiscard]] glm::vec4 colour() const {
        return glm::vec4(redGreen & 0xffffu, redGreen >> 16, blueOpacity & 0xffffu, blueOpacity >> 16) / 65535.0f;
    }

 private:
    static std::uint32_t pair(float low, float high) { return step(low) | step(high) << 16; }
    static std::uint32_t step(float share) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 65535.0f));
    }
};

struct alignas(64) Voxel {
    static constexpr std::uint32_t active = 1;       ///< part of the shape
    static constexpr std::uint32_t switchedOff = 2;  ///< for now, within something solid
    static constexpr std::uint32_t forceShift = 8;

    glm::vec3 force{0};     ///< ω
    float forceNumber = 0;  ///< k; of a spiral k/|ω|
    PackedColour colour, fadingColour;
    float sizeMetres = 0.05f, fadingSizeMetres = 0.05f;  ///< radius of a puff
    float lifetimeSeconds = 1;                           ///< once outside
    float interpolationSeconds = 0;                      ///< 0: at once
    float picturesPerSecond = 0;                         ///< of an animated texture
    std::uint32_t maximumDensity = 0;                    ///< particles
    std::uint32_t density = 0;                           ///< particles that were in it when they last looked
    std::uint32_t flags = 0;

    [[nodiscard]] bool isActive() const { return (flags & active) != 0; }
    /// Emits, and keeps its particles alive.
    [[nodiscard]] bool isOn() const { return (flags & (active | switchedOff)) == active; }
    [[nodiscard]] Force forceKind() const { return static_cast<Force>(flags >> forceShift); }

    void setActive(bool on) { flags = (flags & ~(active | switchedOff)) | (on ? active : 0); }
    void setSwitchedOff(bool off) { flags = (flags & ~switchedOff) | (off ? switchedOff : 0); }
    void setForce(Force kind, const glm::vec3& vector, float number) {
        flags = (flags & 0xffu) | static_cast<std::uint32_t>(kind) << forceShift;
        force = vector;
        const float rate = glm::length(vector);
        forceNumber = kind == Force::spiral && rate > 0 ? number / rate : number;
    }
};
static_assert(sizeof(Voxel) == 64);

}  // namespace dustbench::voxel_shape
