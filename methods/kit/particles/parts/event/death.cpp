// An event at each death, of whatever cause.
#include "methods/kit/particles/events.h"

namespace dustbench::particles::parts::event::death {
namespace {

class Death final : public EventPart {
 public:
    using EventPart::EventPart;
    [[nodiscard]] Watched watches() const override { return Watched::deaths; }
    void find(const Happened& happened, std::vector<Event>& events) const override {
        events.insert(events.end(), happened.deaths.begin(), happened.deaths.end());
    }
};

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "at each death, of whatever cause";
    info.source = "Thesis, 7.3";
    EventPart::declareAction(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<Death>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::event::death
