// Births distributed uniformly over the surface of a mesh: a triangle by its area, then a point on it.
//
// The mesh's origin is the source's centre; its axes x, y, z are the emitter's forward, up, right. The thesis emits
// from lines, balls and discs; this extends the method to any surface.
#include <algorithm>
#include <array>
#include <vector>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::position::mesh {
namespace {

/// A number in [0, 1) with 53 bits: fine enough for a mesh with many triangles.
double unitDouble(std::uint32_t high, std::uint32_t low) {
    return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1p-53;
}

class MeshSource final : public PlacedSource {
 public:
    /// Throws InputError if the mesh cannot be used.
    explicit MeshSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    [[nodiscard]] glm::vec3 point(std::uint64_t seed, std::uint64_t serial) const;

    std::vector<std::array<glm::vec3, 3>> triangles_;
    std::vector<double> areaUpTo_;  ///< of all triangles up to and including this one
};

MeshSource::MeshSource(const ParameterValues& values) : PlacedSource(values), triangles_(trianglesOf(values)) {
    double sum = 0;
    areaUpTo_.reserve(triangles_.size());
    for (const auto& triangle : triangles_) areaUpTo_.push_back(sum += areaOf(triangle));
}

glm::vec3 MeshSource::point(std::uint64_t seed, std::uint64_t serial) const {
    const auto words = maths::randomWords(seed, positionStream, serial, 0);
    const double area = unitDouble(words[0], words[1]) * areaUpTo_.back();
    const auto found = std::min(std::ranges::upper_bound(areaUpTo_, area), areaUpTo_.end() - 1);
    const auto& triangle = triangles_[static_cast<std::size_t>(found - areaUpTo_.begin())];
    const glm::vec3 weights = maths::triangleWeights(maths::unitFloat(words[2]), maths::unitFloat(words[3]));
    return weights.x * triangle[0] + weights.y * triangle[1] + weights.z * triangle[2];
}

void MeshSource::place(Newborns& newborns, const Step& step) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const glm::vec3 local = point(step.seed, newborns.chunk.serial[i]);
        newborns.setPosition(i, newborns.centre(i) + newborns.emitter[i]->toWorld(local));
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "the surface of a mesh";
    info.source = "Thesis, 4.2; Turk1990";
    PlacedSource::declare(info.parameters);
    declareMesh(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<MeshSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::mesh
