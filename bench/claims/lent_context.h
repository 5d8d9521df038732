// What the harness lends an experiment: its seed, worlds as runs have them, and an OpenGL device made when first
// wanted.
//
// Owns: the device. The worlds it gives out are their own.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "methods/contract/experiment.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

class LentContext final : public ExperimentContext {
 public:
    explicit LentContext(std::uint64_t seed) : seed_(seed) {}

    [[nodiscard]] std::uint64_t seed() const override { return seed_; }
    [[nodiscard]] gpu::Device& device() override;
    [[nodiscard]] std::unique_ptr<ExperimentWorld> world(const std::string& scene,
                                                         const std::map<std::string, std::string>& parameters,
                                                         int width, int height) override;

 private:
    std::uint64_t seed_;
    std::optional<gpu::Device> device_;
};

}  // namespace dustbench::bench
