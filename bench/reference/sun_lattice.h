// Interpolates the optical depth towards the sun (light::SunDepth) at many points of a cloud.
//
// Each octave of puff widths has its own lattice, with a node spacing of at most a quarter of the standard deviation of
// its narrowest puff. Nodes store the closed form. Between them the depth is interpolated by cubics along the three
// axes, which is of fourth order: at this spacing the error is below 1e-3 of a puff's own depth, and it averages out
// where many puffs overlap. An octave that would need more than `maximumNodes` uses the closed form instead.
//
// Units: metres; depth has none. Frame: world. Owns: the lattices. Threads: the constructor uses the current oneTBB
// arena, bit-identical at any number of threads; const access from any.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/contract/volume.h"
#include "methods/kit/light/sun_depth.h"

namespace dustbench::reference {

class SunLattice {
 public:
    static constexpr std::size_t defaultNodes = std::size_t{1} << 25;

    /// Parameters as for light::SunDepth; throws as it does. `spacingMetres`: maximum distance between nodes.
    SunLattice(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected,
               double spacingMetres, std::size_t maximumNodes = defaultNodes);

    [[nodiscard]] double at(const glm::dvec3& position) const;

    /// Number of nodes of all lattices.
    [[nodiscard]] std::size_t nodes() const;

 private:
    /// A puff in the sun's frame: (u, v) across its direction, w towards it.
    struct Entry {
        glm::dvec3 centre;
        double deviation, depth, reach;
    };
    struct Octave {
        glm::dvec3 origin;  ///< of node (0, 0, 0)
        double spacing;
        glm::ivec3 nodes;
        std::vector<float> depths;  ///< u fastest

        [[nodiscard]] double at(const glm::dvec3& place) const;
    };

    [[nodiscard]] static std::optional<Octave> latticeOf(const std::vector<Entry>& puffs, double spacing,
                                                         std::size_t maximumNodes);
    static void fill(Octave& octave, const std::vector<Entry>& puffs);

    glm::dmat3 toSunFrame_;
    std::vector<Octave> octaves_;
    std::optional<light::SunDepth> rest_;
};

}  // namespace dustbench::reference
