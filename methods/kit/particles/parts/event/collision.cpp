// An event at each contact with a surface of the system that is faster than a limit, so that resting particles, which
// touch the surface in every step, are silent.
#include "methods/kit/particles/events.h"

namespace dustbench::particles::parts::event::collision {
namespace {

class HitEvents final : public EventPart {
 public:
    explicit HitEvents(const ParameterValues& values)
        : EventPart(values),
          surface_(static_cast<int>(values.integer("surface"))),
          minimumSpeed_(static_cast<float>(values.real("minimum_speed"))) {}

    [[nodiscard]] Watched watches() const override { return Watched::hits; }
    void find(const Happened& happened, std::vector<Event>& events) const override {
        for (const Hit& hit : happened.hits)
            if ((surface_ == 0 || hit.surface == surface_) && hit.speed >= minimumSpeed_) events.push_back(hit.event);
    }

 private:
    int surface_;
    float minimumSpeed_;
};

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "at each contact with a surface of `bounce` or of life `collision`, both in mode fixed";
    info.source = "Thesis, 6.1 and 7.3";
    info.parameters
        .integer("surface", 0, 0, 32, "",
                 "number of the surface among those of the system: of its forces, then of its lives, in the order of "
                 "the file; 0: any")
        .real("minimum_speed", 0.3, 0, 1e6, "m/s", "speed into the surface; slower contacts are not events");
    EventPart::declareAction(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<HitEvents>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::event::collision
