// Curves through the positions of the last steps.
//
// The store moves particles when others die: a particle that is not at its previous index was at the end, beyond the
// present size. A particle that is not found at all is new and is assumed to have moved straight along its velocity.
//
// Units: m, s. Frame: world. Owns: the positions, a column for each step and axis. Threads: one writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

#include "methods/contract/volume.h"
#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {

/// The positions of each particle of a system at the last steps.
class LastPositions {
 public:
    /// Keeps `positions` per particle, including the present one; at least two.
    explicit LastPositions(std::size_t positions) : moments_(positions) {}

    /// Adds the present positions. Call this once per step.
    void follow(const Puffs& puffs, float stepSeconds);

    /// The position of particle `i` `stepsBack` steps before the last `follow`, in the order of that call.
    [[nodiscard]] glm::vec3 at(std::size_t i, std::size_t stepsBack) const {
        const Moment& moment = moments_[(newest_ + moments_.size() - stepsBack) % moments_.size()];
        return {moment[0][i], moment[1][i], moment[2][i]};
    }
    [[nodiscard]] std::size_t bytes() const;

 private:
    using Moment = std::array<std::vector<float>, 3>;
    using Places = std::unordered_map<std::uint64_t, std::size_t>;

    /// The particles that were at index `size` or beyond, by serial.
    [[nodiscard]] Places placesBeyond(std::size_t size) const;
    void resize(std::size_t size);
    void begin(const Puffs& puffs, std::size_t i, float stepSeconds);
    void move(std::size_t from, std::size_t to);

    std::vector<Moment> moments_;  ///< ring buffer
    std::size_t newest_ = 0;
    std::vector<std::uint64_t> serial_;
};

[[nodiscard]] std::unique_ptr<ShapePass> makeCurvePass(gpu::Device& device, const particles::Look& look);

}  // namespace dustbench::plugin_particles
