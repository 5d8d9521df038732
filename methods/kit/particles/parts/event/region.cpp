// An event where a particle enters a region: where its path of a step passes the region's surface.
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/events.h"
#include "methods/kit/particles/surface_shapes.h"

namespace dustbench::particles::parts::event::region {
namespace {

class Region final : public EventPart {
 public:
    /// Throws InputError if the surface cannot be used.
    explicit Region(const ParameterValues& values) : EventPart(values), surface_(makeSurface(values)) {}

    [[nodiscard]] Watched watches() const override { return Watched::ways; }
    void begin(const Step& step) override { surface_->begin(step); }
    [[nodiscard]] std::optional<Mark> mark() const override { return markOfSurface(values()); }
    void find(const Happened& happened, std::vector<Event>& events) const override;

 private:
    std::unique_ptr<Surface> surface_;
};

void Region::find(const Happened& happened, std::vector<Event>& events) const {
    const Ways& all = happened.ways;
    std::vector<float> share(all.count);
    parallel::forEachBlock(all.count, 2048, [&](std::size_t i, std::size_t count) {
        surface_->meet({count, all.fromX + i, all.fromY + i, all.fromZ + i, all.toX + i, all.toY + i, all.toZ + i,
                        all.seconds + i},
                       &share[i]);
    });
    for (std::size_t i = 0; i < all.count; ++i) {
        if (share[i] <= 0 || share[i] > 1) continue;  // 0: it was inside before
        const Touch touch = surface_->touchAt({all.from(i), all.to(i), all.seconds[i], share[i]});
        events.push_back({touch.point, happened.moved[i].velocity, touch.normal, happened.moved[i].serial});
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "where a particle enters a half-space or a ball, or passes a disc, a mesh or a surface of the scene";
    info.source = "Thesis, 7.3";
    declareSurface(info.parameters);
    EventPart::declareAction(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<Region>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::event::region
