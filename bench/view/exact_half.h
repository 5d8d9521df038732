// The ground truth of one moment as textures, and the metrics of a method compared with it.
//
// bench/reference draws it, as for the metrics of a run (bench/reference/judge). That takes from a few milliseconds to
// seconds. Owns: its textures. Threads: the device's, inside the oneTBB arena to be used.
#pragma once

#include <optional>
#include <string>

#include "bench/reference/judge/moment_metrics.h"
#include "bench/view/split_view.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

class ExactHalf {
 public:
    ExactHalf(gpu::Device& device, int width, int height);

    /// Draws the dust, given in its colours without light, in front of the method's scene and compares the method's
    /// picture with it. `whyNotEvaluated`: why metrics would be meaningless; if empty, they are computed.
    void draw(const DrawnMoment& drawn, const scene::Scene& scene, const scene::View& view, const Puffs& dust,
              std::string whyNotEvaluated);

    [[nodiscard]] HalfTextures textures() const { return {display_, scene_, layer_, depth_}; }
    /// The ground truth and the method's picture: linear light, opaque.
    [[nodiscard]] const EvaluatedMoment& evaluated() const { return evaluated_; }
    /// Why `evaluated` has no metrics; empty if it has.
    [[nodiscard]] const std::string& whyNotEvaluated() const { return whyNotEvaluated_; }
    /// Duration of the last draw(), including metrics.
    [[nodiscard]] double seconds() const { return seconds_; }

 private:
    gpu::Texture display_, scene_, layer_, depth_;
    EvaluatedMoment evaluated_;
    std::string whyNotEvaluated_;
    double seconds_ = 0;
};

}  // namespace dustbench::bench
