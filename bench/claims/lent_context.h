// The context of an experiment: its seed, whether it is a quick run, worlds as in runs, and an OpenGL device that is
// created on first use.
//
// Owns: the device. Worlds are owned by the caller.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "methods/contract/experiment.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
