// Events at times: first + k·interval, in the system's own time, which includes the preroll.
#include <algorithm>
#include <cmath>

#include "methods/kit/particles/events.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::event::timer {
namespace {

class Timer final : public EventPart {
 public:
    explicit Timer(const ParameterValues& values)
        : EventPart(values),
          first_(values.real("first_seconds")),
          interval_(values.real("interval_seconds")),
          place_(vectorOf(values, "place", spaceAxes)) {}

    [[nodiscard]] Watched watches() const override { return Watched::time; }
    void find(const Happened& happened, std::vector<Event>& events) const override;

 private:
    double first_, interval_;
    glm::vec3 place_;
};

/// Those of the step [begin, end): the end of a step is the beginning of the next, so that none is lost.
void Timer::find(const Happened& happened, std::vector<Event>& events) const {
    const auto timeOf = [&](double k) { return first_ + k * interval_; };
    double k = interval_ > 0 ? std::max(std::floor((happened.beginSeconds - first_) / interval_) - 1, 0.0) : 0;
    for (; timeOf(k) < happened.endSeconds; ++k) {
        if (timeOf(k) >= happened.beginSeconds)
            events.push_back({place_, glm::vec3(0), {0, 1, 0}, static_cast<std::uint64_t>(k)});
        if (interval_ == 0) break;
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "at given times";
    info.source = "Thesis, 7.3";
    info.parameters.real("first_seconds", 1, 0, 1e6, "s", "since the start of the system, the preroll included")
        .real("interval_seconds", 0, 0, 1e6, "s", "between events; 0: only one");
    declareVector(info.parameters, "place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m", "of the event, in the world");
    EventPart::declareAction(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<Timer>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::event::timer
