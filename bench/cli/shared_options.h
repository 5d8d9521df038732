// Options that several subcommands share, with their parsing and checks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/cli/arguments.h"
#include "bench/export/volume_settings.h"
#include "bench/results/run_spec.h"
#include "bench/suite/suite.h"

namespace dustbench::cli {

/// `name=value` of every -P option, in order; values may be lists and ranges. Throws InputError.
[[nodiscard]] suite::ParameterLists parseParameters(const std::vector<std::string>& texts);

/// Loads every scene and drive of the plan once and looks up the files that parameters refer to, so that their errors
/// are reported before the first run. Throws InputError.
void checkWorlds(const std::vector<suite::PlannedRun>& plan);

/// The options that select a method and a world.
struct WorldOptions {
    std::string method;
    std::string scene = results::RunSpec().scene, drive, cameraPath, dust, dustColumns, dustOn = "auto";
    std::vector<std::string> parameters;  ///< values of -P, not yet parsed
    std::vector<std::string> changes;     ///< values of --at
    std::int64_t warmup = results::RunSpec().warmup;
    std::string size = "640x480";
    std::int64_t seed = 1, threads = 0;

    void declare(Arguments& arguments);
    /// All except the method.
    void declareWorld(Arguments& arguments);
    /// The values of -P and --at. Throws InputError if the method has no settings that can change during a run.
    [[nodiscard]] suite::ParameterLists parameterLists() const;
    /// All except the parameters. Throws InputError for an unknown name.
    [[nodiscard]] results::RunSpec toSpec() const;
    /// All except the parameters and the method.
    [[nodiscard]] results::RunSpec toWorldSpec() const;
};

/// The options of `export`, `run` and `suite` that select volumes.
class VolumeOptions {
 public:
    /// `framesName` is `--frames` if frames are mandatory, or `--volumes` if volumes are optional.
    explicit VolumeOptions(std::string framesName) : framesName_(std::move(framesName)) {}

    void declareRequired(Arguments& arguments);
    void declareOptional(Arguments& arguments);
    /// The given options, with `base` as default. Empty: no volumes. Throws InputError, also if another volume option
    /// is given without frames.
    [[nodiscard]] std::optional<exports::VolumeSettings> over(const std::optional<exports::VolumeSettings>& base) const;

 private:
    void declareRest(Arguments& arguments);

    std::string framesName_;
    std::string frames_, formats_, resolution_, region_;
    std::map<std::string, std::string> options_;  ///< of formats, by id
};

}  // namespace dustbench::cli
