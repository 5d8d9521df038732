// The ground truth of the shared dust, drawn on the GPU as a method.
//
// Each tile of 8 × 8 pixels has a list of the puffs that reach into it. A compute shader sums their optical depths
// along each pixel's ray by the closed form of the optical model (maths/transmittance.h), limited by eye and scene,
// without quads, sorting, voxels or steps. Dust of several colours is marched through in slabs whose depths are exact
// and whose colours are evenly mixed; halving the slabs divides the error by four.
//
// Units: metres. Colours: linear RGB, premultiplied.
// Source: Olsson2011, 3. Departs: lists of puffs instead of lists of lights.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/exact_tiles/puff_tiles.h"
#include "methods/kit/draw/loop_limit.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::exact_tiles {

struct Settings {
    double toleratedDepth = 1e-6;  ///< maximum optical depth neglected per pixel
    double slabDeviations = 0.5;   ///< step length through several colours, in units of the smallest s in a tile
    int rowsAtOnce = 0;            ///< pixels that an invocation sums: 1, 2, 4 or 8; 0: chosen for the device
};

class ExactTiles final : public Method {
 public:
    explicit ExactTiles(const Settings& settings) : settings_(settings), tiles_(ledger_) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override { return static_cast<std::int64_t>(tiles_.puffs().size()); }

 private:
    [[nodiscard]] bool isListedFor(const scene::View& view) const;
    [[nodiscard]] gpu::Program& program(bool oneColour);

    Settings settings_;
    MemoryLedger ledger_;
    PuffTiles tiles_;
    gpu::Device* device_ = nullptr;
    gpu::Buffer puffs_, lists_, entries_;
    std::optional<draw::LoopLimit> loops_;
    std::optional<gpu::Program> sum_, march_;  ///< compiled on first use
    std::optional<scene::View> listedFor_;     ///< the view that the lists were made for
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::exact_tiles
