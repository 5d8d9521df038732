#include "methods/voxel_shape/births_experiment.h"

#include <algorithm>
#include <memory>
#include <string>

#include "methods/voxel_shape/voxel_shape.h"
#include "methods/voxel_shape/voxels/solid_space.h"

namespace dustbench::voxel_shape::births {
namespace {

constexpr const char* walls = "wall";
constexpr double secondsPastTwoWalls = 3.5;
constexpr int width = 64, height = 48;

/// Counts the particles with new serials, and those of them that are in a solid.
class NewbornCount final : public VolumeVisitor {
 public:
    explicit NewbornCount(const scene::Scene& scene) : solids_(scene) {}

    void puffs(const Puffs& puffs) override {
        std::uint64_t next = nextSerial_;
        for (std::size_t i = 0; i < puffs.size(); ++i) {
            if (puffs.serial[i] < nextSerial_) continue;
            next = std::max(next, puffs.serial[i] + 1);
            ++report_.births;
            report_.inSolids += solids_.contains(glm::dvec3(puffs.x[i], puffs.y[i], puffs.z[i])) ? 1 : 0;
        }
        nextSerial_ = next;
    }
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume&) override {}

    [[nodiscard]] const BirthReport& report() const { return report_; }

 private:
    SolidSpace solids_;
    std::uint64_t nextSerial_ = 0;  ///< serials increase with every birth
    BirthReport report_;
};

}  // namespace

BirthReport driveThroughWalls(ExperimentContext& context, bool solidsAreKnown, double seconds) {
    // The dust of the wheels is irrelevant here: a few particles suffice.
    const auto world = context.world(walls, {{"particles", "10"}, {"preroll", "0"}}, width, height);
    scene::Scene known = world->scene();
    if (!solidsAreKnown) {
        known.solids.clear();
        known.solidPoses.clear();
    }
    const MethodInfo info = voxel_shape::describe();
    const std::unique_ptr<Method> shape = info.create(ParameterValues(info.parameters));
    shape->prepare(known, world->setup(), context.device());
    NewbornCount newborn(world->scene());
    for (double driven = 0; driven < seconds;) {
        const Frame frame = world->step();
        shape->update(frame);
        shape->volume(frame, newborn);
        driven += frame.stepSeconds;
    }
    return newborn.report();
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Counts the particles that a shape emits inside the walls that it passes through.";
    info.source = "JuckelBeckhaus2007";
    info.run = [](ExperimentContext& context) {
        std::vector<Finding> findings;
        for (const bool known : {true, false}) {
            const BirthReport report = driveThroughWalls(context, known, secondsPastTwoWalls);
            const auto count = static_cast<double>(report.inSolids);
            findings.push_back({known ? "in_solids" : "in_solids_untold", count, count, count, report.births});
        }
        return findings;
    };
    return info;
}

}  // namespace dustbench::voxel_shape::births
