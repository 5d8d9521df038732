// A steady stream of births, at a rate that may grow with the vehicle's speed; fractions carry over between steps.
//
// rate = rate_per_second + rate_per_metre·speed. A birth happens when the running count passes a whole number, so that
// births are evenly spaced in time at any step length. Departs from its source, the fractional accumulator: each birth
// has its own moment within the step.
#include <cmath>

#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::emission::stream {
namespace {

class Stream final : public EmissionPart {
 public:
    explicit Stream(const ParameterValues& values);

    [[nodiscard]] Births births(const Step& step) override;
    [[nodiscard]] bool neverEmits() const override { return ratePerSecond_ <= 0 && ratePerMetre_ <= 0; }
    [[nodiscard]] double meanRatePerSecond() const override { return ratePerSecond_; }
    void takeOver(const Part& before) override {
        if (const auto* stream = dynamic_cast<const Stream*>(&before)) carried_ = stream->carried_;
    }

 private:
    double ratePerSecond_, ratePerMetre_;
    double carried_ = 0;  ///< fraction of a particle that is already due, [0, 1)
};

Stream::Stream(const ParameterValues& values)
    : EmissionPart(values),
      ratePerSecond_(values.real("rate_per_second")),
      ratePerMetre_(values.real("rate_per_metre")) {}

Births Stream::births(const Step& step) {
    const double speed = step.scene.vehicle ? step.state.vehicle.speed : 0;
    const double ratePerPuff =
        step.fixedRatePerSecond > 0 ? step.fixedRatePerSecond : ratePerSecond_ + ratePerMetre_ * std::abs(speed);
    const double rate = ratePerPuff * static_cast<double>(step.particlesPerPuff);
    if (rate <= 0) return {};
    const double due = carried_ + rate * step.seconds;
    const double whole = std::floor(due);
    const Births births{static_cast<std::int64_t>(whole), (1 - carried_) / rate, 1 / rate};
    carried_ = due - whole;
    return births;
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a steady stream, faster with the vehicle's speed";
    info.source = "Thesis, 4.6.1";
    info.parameters.real("rate_per_second", 0, 0, 1e12, "1/s", "births per second, from all emitters together")
        .real("rate_per_metre", 40, 0, 1e9, "1/m", "additional births per metre driven");
    info.create = [](const ParameterValues& values) { return std::make_unique<Stream>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::emission::stream
