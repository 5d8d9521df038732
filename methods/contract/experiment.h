// Experiments and tools, which a folder under methods/ may contain in addition to a method. Experiments test claims
// that runs cannot test; tools add commands to `dustbench`. Each is one file, `<id>_experiment.cpp` or
// `<id>_tool.cpp`, with `ExperimentInfo describe()` or `ToolInfo describe()` in the namespace
// dustbench::<folder>::<id>.
//
// Threads: the current oneTBB arena; findings do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "methods/contract/method.h"

namespace dustbench {

/// A number found by an experiment, with its 95 % interval; if nothing is random, the minimum and maximum of the
/// observed values. A number that was not measured is NaN, and the note says why.
struct Finding {
    std::string quantity;
    double value = 0;
    double low = 0, high = 0;
    std::int64_t samples = 0;  ///< draws, steps, pixels or births behind the value
    std::string note{};        ///< caveats for the reader, such as omitted cases; may be empty
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

/// Services that the harness provides to an experiment or a tool.
class DUSTBENCH_API ExperimentContext {
 public:
    virtual ~ExperimentContext();
    /// The only source of randomness.
    [[nodiscard]] virtual std::uint64_t seed() const = 0;
    /// True for a quick run: seconds instead of minutes.
    [[nodiscard]] virtual bool quick() const = 0;
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

/// An option of a tool (`--save`), or a required argument if the name has no dashes.
struct ToolOption {
    std::string name, placeholder, help;
    bool repeats = false;  ///< may be given several times
};

struct ToolArgument {
    std::string name, value;
};

/// The command `dustbench <id>`.
struct ToolInfo {
    std::string summary;  ///< a few words
    std::string manual;   ///< shown below the options in its help
    std::vector<ToolOption> options;
    /// Receives the arguments in the order given. Returns the table to print: rows of cells, the first of them the
    /// header. Throws InputError, with nothing written.
    std::function<std::vector<std::vector<std::string>>(ExperimentContext&, std::span<const ToolArgument>)> run;
    std::string id{};      ///< file name without `_tool.cpp`; set by the registry
    std::string folder{};  ///< as for experiments
};

}  // namespace dustbench
