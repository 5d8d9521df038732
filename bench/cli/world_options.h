// The options by which commands name one method in one world.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cli/arguments.h"
#include "bench/results/run_spec.h"

namespace dustbench::cli {

struct WorldOptions {
    std::string method;
    std::string scene = bench::RunSpec().scene, drive;
    std::vector<std::string> parameters;  ///< of -P, not yet looked at
    std::int64_t warmup = bench::RunSpec().warmup;
    std::string size = "640x480";
    std::int64_t seed = 1, threads = 0;

    void declare(Arguments& arguments);
    /// All but the method.
    void declareWorld(Arguments& arguments);
    /// All but the parameters. Throws InputError where a name is unknown.
    [[nodiscard]] bench::RunSpec toSpec() const;
    /// All but the parameters and the method.
    [[nodiscard]] bench::RunSpec toWorldSpec() const;
};

}  // namespace dustbench::cli
