// Experiments: for what papers claim and no run of a method can answer. A folder of methods/ holds one in each
// `<id>_experiment.cpp`, whose `ExperimentInfo describe()` stands in the namespace dustbench::<folder>::<id>.
//
// Threads: the current oneTBB arena; the findings are the same at any number of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "methods/contract/method.h"

namespace dustbench {

/// A number that an experiment finds, with its 95 % interval; where no chance enters, the minimum and the maximum of
/// what was looked at.
struct Finding {
    std::string quantity;
    double value = 0;
    double low = 0, high = 0;
    std::int64_t samples = 0;  ///< draws, steps, pixels or births behind it
};

/// A scene with its vehicle on its drive and its dust, as a run has it.
class DUSTBENCH_API ExperimentWorld {
 public:
    virtual ~ExperimentWorld();
    [[nodiscard]] virtual const scene::Scene& scene() const = 0;
    [[nodiscard]] virtual RunSetup setup() const = 0;
    /// One step on. The frame is seen by the scene's camera, and valid until the next step.
    [[nodiscard]] virtual Frame step() = 0;
};

/// What the harness lends an experiment.
class DUSTBENCH_API ExperimentContext {
 public:
    virtual ~ExperimentContext();
    /// All chance of the experiment comes from it.
    [[nodiscard]] virtual std::uint64_t seed() const = 0;
    /// Made at the first call. Throws InputError where there is no OpenGL.
    [[nodiscard]] virtual gpu::Device& device() = 0;
    /// A world of `data/scenes/<scene>.toml` with parameters as on the command line. Throws InputError.
    [[nodiscard]] virtual std::unique_ptr<ExperimentWorld> world(const std::string& scene,
                                                                 const std::map<std::string, std::string>& parameters,
                                                                 int width, int height) = 0;
};

struct ExperimentInfo {
    std::string summary;  ///< one sentence: what it finds
    std::string source;   ///< key in data/references.bib: whose claim it is for
    std::function<std::vector<Finding>(ExperimentContext&)> run;
    std::string id{};      ///< the file's name before `_experiment.cpp`; the registry fills it in
    std::string folder{};  ///< whose it is: `voxel_shape`, `kit/particles`; the registry fills it in
};

}  // namespace dustbench
