// The fluid of the published demo on the CPU, as a plain implementation: all quantities at the centres of cells, stored
// as halves.
//
// A step advects by MacCormack, forward and clamped to the eight nodes, adds sources and forces, and sweeps the
// pressure six times, so the stored flow is not divergence-free. Units: SI. Frame: world. Owns all fields. Threads:
// slabs in parallel. Source: Crane2007, 30.2; Senger2009, 4.1.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "methods/grid_fluid/flow/solver.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::grid_fluid::demo {

// --- The numbers of the demo, in its own units: cells and steps; the same on the CPU and on the GPU

inline constexpr int jacobiSweeps = 6;
inline constexpr float confinementOfSmoke = 0.0085f, confinementOfFire = 0.03f;  ///< per step
inline constexpr float keptOfScalars = 0.9995f;                                  ///< per step
inline constexpr float airKelvin = 293;
/// Bytes per cell: two velocities and a vector of four halves each; pressure, density, temperature and a temporary
/// scalar of one half each; a solid's velocity of four halves, and a byte that marks solids.
inline constexpr std::size_t bytesOfFlow = 32, bytesOfSolids = 9;

struct DemoSettings {
    flow::FluidBox box;
    flow::Sides sides = flow::openOverFloor;
    float buoyancyPerKelvin = 0.1f;  ///< near the air's own temperature: b·T₀²·(1/T₀ − 1/T)
    float weightPerDensity = 0;
    float reactionLossPerSecond = 0;
    bool burns = false;

    [[nodiscard]] float confinement() const { return burns ? confinementOfFire : confinementOfSmoke; }
    [[nodiscard]] float lift(float seconds) const { return buoyancyPerKelvin * seconds; }
};

/// Returns the same settings; throws like flow::check for their box.
[[nodiscard]] inline const DemoSettings& checked(const DemoSettings& settings) {
    flow::check(settings.box);
    return settings;
}

/// The part of a fluid's settings that the demo uses; the rest is fixed. There is no wind.
[[nodiscard]] inline DemoSettings demoOf(const flow::FluidSettings& settings, bool burns) {
    return {settings.box,
            settings.sides,
            settings.forces.buoyancyPerKelvin,
            settings.forces.weightPerDensity,
            settings.forces.reactionLossPerSecond,
            burns};
}

// --- Fields on the CPU: floats rounded to half precision, x fastest, without ghost cells. Places count in cells from
// the centre of the first cell.

[[nodiscard]] inline float toHalf(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}
[[nodiscard]] inline glm::vec4 toHalf(const glm::vec4& value) {
    return {toHalf(value.x), toHalf(value.y), toHalf(value.z), toHalf(value.w)};
}

template <typename Value>
class DemoGrid {
 public:
    DemoGrid(const glm::ivec3& cells, MemoryAccount& account) : cells_(cells), values_(account) {
        values_.resize(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
                       static_cast<std::size_t>(cells.z));
    }
    [[nodiscard]] std::size_t index(const glm::ivec3& c) const {
        return static_cast<std::size_t>(c.x) +
               static_cast<std::size_t>(cells_.x) *
                   (static_cast<std::size_t>(c.y) + static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(c.z));
    }
    /// The value of the nearest cell in the box.
    [[nodiscard]] const Value& at(const glm::ivec3& c) const {
        return values_[index(glm::clamp(c, glm::ivec3(0), cells_ - 1))];
    }
    void set(const glm::ivec3& c, const Value& value) { values_[index(c)] = toHalf(value); }
    void setAll(const Value& value) { std::fill(values_.begin(), values_.end(), value); }

    /// Calls `take(node, weight)` for the eight nodes around a place.
    template <typename Take>
    void around(const glm::vec3& place, const Take& take) const {
        const glm::ivec3 low(glm::floor(place));
        const glm::vec3 f = place - glm::vec3(low);
        for (int n = 0; n < 8; ++n) {
            const glm::ivec3 d(n & 1, n >> 1 & 1, n >> 2);
            const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(d));
            take(at(low + d), w.x * w.y * w.z);
        }
    }
    [[nodiscard]] Value sampled(const glm::vec3& place) const {
        Value sum(0);
        around(place, [&](const Value& node, float weight) { sum += weight * node; });
        return sum;
    }
    void swap(DemoGrid& other) { values_.swap(other.values_); }

 private:
    glm::ivec3 cells_;
    LedgerVector<Value> values_;
};

class DemoSolver final : public flow::Solver {
 public:
    DemoSolver(const DemoSettings& settings, MemoryLedger& ledger);

    void setSolids(const flow::SolidMask& mask) override;
    flow::StepReport step(double stepSeconds, std::span<const flow::FluidSource> sources,
                          const StageClock& clock = StageClock()) override;
    /// Always throws: the demo's box cannot move.
    void scroll(glm::ivec3 cells) override;
    [[nodiscard]] const flow::FluidBox& box() const override { return settings_.box; }
    [[nodiscard]] std::int64_t steps() const override { return steps_; }
    [[nodiscard]] std::uint64_t stateHash() const override;
    void gather(flow::Lane lane, std::span<float> to) const override;
    void gatherStored(flow::Lane lane, std::span<float> to) const override { gather(lane, to); }
    [[nodiscard]] std::vector<float> pressuresM2PerS2() const override;
    [[nodiscard]] float divergencePerStep() const override;
    [[nodiscard]] bool onGpu() const override { return false; }
    void gather(flow::Lane lane, const gpu::Texture& to) const override;
    void addDensity(std::span<const flow::AddedDensity> added) override;
    [[nodiscard]] MemoryReport gpuMemory() const override { return {}; }

 private:
    using Scalars = DemoGrid<float>;
    using Vectors = DemoGrid<glm::vec4>;
    [[nodiscard]] bool isInside(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) && glm::all(glm::lessThan(c, settings_.box.cells));
    }
    [[nodiscard]] bool isSolid(const glm::ivec3& c) const { return solid_.at(c).w > 0; }
    [[nodiscard]] glm::vec3 neighbourVelocity(const Vectors& velocity, const glm::ivec3& c, int axis, int side) const;
    [[nodiscard]] float neighbourPressure(const Scalars& pressure, const glm::ivec3& c, int axis, int side) const;
    [[nodiscard]] float divergenceAt(const glm::ivec3& c) const;
    template <typename Cell>
    void forCells(const Cell& cell) const;
    template <typename Value>
    void advect(const DemoGrid<Value>& field, DemoGrid<Value>& guess, DemoGrid<Value>& result, float cellsPerSpeed,
                float kept);
    void addSource(const flow::FluidSource& source, float seconds);
    void applyForces(float seconds);
    void project();
    void requireNumbers() const;

    DemoSettings settings_;
    Vectors velocity_, otherVelocity_, vector_;  ///< `w` of a velocity: the reaction
    Scalars density_, temperature_, pressure_, scalar_;
    Vectors solid_;  ///< velocity of a solid; w: whether the cell is solid
    std::int64_t steps_ = 0;
    double lastStepSeconds_ = 0;
};

}  // namespace dustbench::grid_fluid::demo
