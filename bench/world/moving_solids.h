// The solids of a scene that move or deform: their key-framed paths, and the state of all solids at a given time.
//
// Units: s, m, radians. Frame: world. Time 0 is the start of the drive. Threads: const members are safe from any.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/solid.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::world {

struct SolidKey {
    double seconds = 0;
    glm::dvec3 position{0};
    glm::dvec3 turn{0};  ///< about x, then z, then y
    std::vector<double> weights{};
};

/// From the solid's frame to the world: scaled, then turned about x, z and y, then moved.
[[nodiscard]] glm::dmat4 solidToWorld(const glm::dvec3& position, const glm::dvec3& turn, double scale);

/// Each number (three of the position, three angles, a weight for each target) is a piecewise cubic through its keys
/// with continuous velocity. Before the first key and after the last it rests, with zero velocity at both; a repeating
/// path continues from its last key as from its first. Angles are interpolated like other numbers, so a rotation may
/// exceed a full turn (reports/decisions/0017-moving-solids.md).
class SolidPath {
 public:
    struct Moment {
        glm::dvec3 position, turn;
        std::vector<double> weights;
        glm::dvec3 velocity, turnPerSecond;
        std::vector<double> weightsPerSecond;

        [[nodiscard]] scene::SolidPose pose(double scale) const;
    };

    /// One or more keys by ascending time, with equal numbers of weights. A repeating path has two or more, and ends as
    /// it begins, up to whole turns. Throws std::invalid_argument otherwise.
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

/// The solids that move or deform, with their paths and targets.
class MovingSolids {
 public:
    /// Gives the solid with this number a path. `morph`: its targets, if it deforms.
    void add(std::size_t solid, SolidPath path, double scale, std::optional<meshes::MorphMesh> morph);

    /// All solids of the scene at this time; empty if none of them moves.
    [[nodiscard]] std::vector<scene::SolidNow> at(const scene::Scene& scene, double seconds) const;
    /// Memory of the targets.
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct Moving {
        std::size_t solid;
        SolidPath path;
        double scale;
        std::optional<meshes::MorphMesh> morph;
    };
    std::vector<Moving> all_;
};

}  // namespace dustbench::world
