// Runs the methods' experiments (methods/contract/experiment.h) and stores their findings in experiments.csv.
//
// reports/SCHEMA.md defines its columns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::claims {

struct StoredFinding : Finding {
    std::string experiment;
};

/// Throws InputError for an unknown name, or if an experiment needs OpenGL and it is not available.
[[nodiscard]] std::vector<StoredFinding> runExperiment(std::string_view name, bool quick = false,
                                                       std::uint64_t seed = 1);

[[nodiscard]] std::string findingsCsv(const std::vector<StoredFinding>& findings);
/// Findings of a results folder; none if it contains no experiments.csv. Throws InputError if it cannot be read.
[[nodiscard]] std::vector<StoredFinding> readFindings(const std::filesystem::path& folder);

/// What an experiment is lent: its seed, whether it is a quick run, worlds as in runs, which the caller owns, and an
/// OpenGL device that is created on first use.
class ProgramContext final : public ExperimentContext {
 public:
    explicit ProgramContext(std::uint64_t seed, bool quick = false) : seed_(seed), quick_(quick) {}

    [[nodiscard]] std::uint64_t seed() const override { return seed_; }
    [[nodiscard]] bool quick() const override { return quick_; }
    [[nodiscard]] gpu::Device& device() override;
    [[nodiscard]] std::unique_ptr<ExperimentWorld> world(const std::string& scene,
                                                         const std::map<std::string, std::string>& parameters,
                                                         int width, int height) override;

 private:
    std::uint64_t seed_;
    bool quick_;
    std::optional<gpu::Device> device_;
};

}  // namespace dustbench::claims
