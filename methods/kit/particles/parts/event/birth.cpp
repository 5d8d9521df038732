// An event at each birth.
#include "methods/kit/particles/events.h"

namespace dustbench::particles::parts::event::birth {
namespace {

class Birth final : public EventPart {
 public:
    using EventPart::EventPart;
    [[nodiscard]] Watched watches() const override { return Watched::births; }
    void find(const Happened& happened, std::vector<Event>& events) const override {
        events.insert(events.end(), happened.births.begin(), happened.births.end());
    }
};

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "at each birth, where the particle is at the end of the step";
    info.source = "Thesis, 7.3";
    EventPart::declareAction(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<Birth>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::event::birth
