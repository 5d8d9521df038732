// The path of a solid: where it is, how it is turned, and how far it is deformed, from key to key.
//
// Each number (three of the place, three angles, a weight for each target) goes through its keys as a piecewise cubic
// whose velocity is continuous. Before the first key and after the last it rests, and so begins and ends without a
// jolt; a path that repeats goes on from its last key as from its first. Angles are numbers like all others, so a turn
// may be longer than a circle (reports/decisions/0017-moving-solids.md).
// Units: s, m, radians. Frame: world. Time 0 is the start of the drive. Threads: const members are safe from any.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::bench {

struct SolidKey {
    double seconds = 0;
    glm::dvec3 position{0};
    glm::dvec3 turn{0};  ///< about x, then z, then y
    std::vector<double> weights{};
};

/// From the solid's frame to the world: scaled, then turned about x, z and y, then moved.
[[nodiscard]] glm::dmat4 solidToWorld(const glm::dvec3& position, const glm::dvec3& turn, double scale);

class SolidPath {
 public:
    struct Moment {
        glm::dvec3 position, turn;
        std::vector<double> weights;
        glm::dvec3 velocity, turnPerSecond;
        std::vector<double> weightsPerSecond;

        [[nodiscard]] scene::SolidPose pose(double scale) const;
    };

    /// One key or more by ascending time, with as many weights each; a path that repeats has two or more, and ends as
    /// it begins but for whole turns. Throws std::invalid_argument otherwise.
    SolidPath(const std::vector<SolidKey>& keys, bool repeats);

    [[nodiscard]] Moment at(double seconds) const;

 private:
    using Numbers = std::vector<double>;
    struct Key {
        double seconds;
        Numbers numbers, perSecond;
    };
    void findVelocities();
    [[nodiscard]] double slopeAfter(std::size_t key, std::size_t number) const;

    std::vector<Key> keys_;
    bool repeats_;
};

}  // namespace dustbench::bench
