#include "bench/experiments/birth_experiment.h"

#include <algorithm>
#include <memory>
#include <string>

#include "bench/experiments/solid_space.h"
#include "bench/scene/world.h"
#include "methods/shared/particles/particle_store.h"
#include "methods/shared/registry.h"
#include "methods/shared/volume.h"

namespace dustbench::bench {
namespace {

constexpr const char* method = "voxel_shape";
constexpr const char* walls = "wall";
constexpr double secondsPastTwoWalls = 3.5;
constexpr int width = 64, height = 48;

/// Counts the particles whose serials have not been there before, and those of them that lie in a solid.
class NewbornCount final : public VolumeVisitor {
 public:
    explicit NewbornCount(const scene::Scene& scene) : solids_(scene) {}

    void puffs(const particles::ParticleStore& puffs) override {
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
    std::uint64_t nextSerial_ = 0;  ///< serials rise with birth
    BirthReport report_;
};

World worldWithWalls() {
    ParameterValues parameters(worldParameters());
    parameters.set("particles", "10");  // of the wheels' dust, which is not what is looked at
    parameters.set("preroll", "0");
    return World(walls, "", parameters, 1);
}

}  // namespace

BirthReport driveThroughWalls(gpu::Device& device, bool solidsAreTold, double seconds) {
    World world = worldWithWalls();
    scene::Scene told = world.scene();
    if (!solidsAreTold) {
        told.solids.clear();
        told.solidPoses.clear();
    }
    const MethodInfo& info = findMethod(method);
    const std::unique_ptr<Method> shape = info.create(ParameterValues(info.parameters));
    shape->prepare(told, device);
    NewbornCount newborn(world.scene());
    const StageClock unheard;
    for (int step = 0; step * stepSeconds < seconds; ++step) {
        world.readInput();
        world.simulate();
        const scene::View view = world.view(width, height);
        const Frame frame{step, stepSeconds, world.state(), world.dust(), view, unheard};
        shape->update(frame);
        shape->volume(frame, newborn);
    }
    return newborn.report();
}

std::vector<Finding> lookForBirthsInSolids() {
    gpu::Device device;
    std::vector<Finding> findings;
    for (const bool told : {true, false}) {
        const BirthReport report = driveThroughWalls(device, told, secondsPastTwoWalls);
        const auto count = static_cast<double>(report.inSolids);
        findings.push_back({"births", told ? "in_solids" : "in_solids_untold", count, count, count, report.births});
    }
    return findings;
}

}  // namespace dustbench::bench
