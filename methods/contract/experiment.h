// Experiments test claims of papers that no run of a method can test. A folder under methods/ defines each one in
// `<id>_experiment.cpp`, with `ExperimentInfo describe()` in the namespace dustbench::<folder>::<id>.
//
// Threads: the current oneTBB arena; findings do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "methods/contract/method.h"

namespace dustbench {

/// A number found by an experiment, with its 95 % interval; if nothing is random, the minimum and maximum of the
/// observed values.
struct Finding {
    std::string quantity;
    double value = 0;
    double low = 0, high = 0;
    std::int64_t samples = 0;  ///< draws, steps, pixels or births behind the value
};

/// A scene with its vehicle, drive and dust, set up as for a run.
class DUSTBENCH_API ExperimentWorld {
 public:
    virtual ~ExperimentWorld();
    [[nodiscard]] virtual const scene::Scene& scene() const = 0;
    [[nodiscard]] virtual RunSetup setup() const = 0;
    /// Advances one step. The frame is seen by the scene's camera and stays valid until the next step.
    [[nodiscard]] virtual Frame step() = 0;
};

/// Services that the harness provides to an experiment.
class DUSTBENCH_API ExperimentContext {
 public:
    virtual ~ExperimentContext();
    /// The only source of randomness for the experiment.
    [[nodiscard]] virtual std::uint64_t seed() const = 0;
    /// Created on first call. Throws InputError if OpenGL is unavailable.
    [[nodiscard]] virtual gpu::Device& device() = 0;
    /// A world from `data/scenes/<scene>.toml`, with parameters as on the command line. Throws InputError.
    [[nodiscard]] virtual std::unique_ptr<ExperimentWorld> world(const std::string& scene,
                                                                 const std::map<std::string, std::string>& parameters,
                                                                 int width, int height) = 0;
};

struct ExperimentInfo {
    std::string summary;  ///< one sentence: what it measures
    std::string source;   ///< key in data/references.bib of the paper that makes the claim
    std::function<std::vector<Finding>(ExperimentContext&)> run;
    std::string id{};      ///< file name without `_experiment.cpp`; set by the registry
    std::string folder{};  ///< folder of the experiment: `voxel_shape`, `kit/particles`; set by the registry
};

}  // namespace dustbench
