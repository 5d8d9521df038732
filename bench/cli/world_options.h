// The options that select a method and a world.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cli/arguments.h"
#include "bench/results/run_spec.h"
#include "bench/suite/suite.h"

namespace dustbench::cli {

struct WorldOptions {
    std::string method;
    std::string scene = bench::RunSpec().scene, drive, cameraPath, dust, dustColumns, dustOn = "auto";
    std::vector<std::string> parameters;  ///< values of -P, not yet parsed
    std::vector<std::string> changes;     ///< values of --at
    std::int64_t warmup = bench::RunSpec().warmup;
    std::string size = "640x480";
    std::int64_t seed = 1, threads = 0;

    void declare(Arguments& arguments);
    /// All except the method.
    void declareWorld(Arguments& arguments);
    /// The values of -P and --at. Throws InputError if the method has no settings that can change during a run.
    [[nodiscard]] bench::ParameterLists parameterLists() const;
    /// All except the parameters. Throws InputError for an unknown name.
    [[nodiscard]] bench::RunSpec toSpec() const;
    /// All except the parameters and the method.
    [[nodiscard]] bench::RunSpec toWorldSpec() const;
};

}  // namespace dustbench::cli
