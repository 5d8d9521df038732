// Bursts of births: `count` particles within `duration`, again after each `interval`.
//
// G(t) counts bursts up to the time t, fractions included: G = k + min(1, (t − k·interval)/duration) in burst k. A
// particle is born whenever count·G passes a whole number. Departs from its source, a time counter that is tested once
// per frame: each birth has its own moment, so that births do not depend on the step's length.
#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::emission::bursts {
namespace {

class Bursts final : public EmissionPart {
 public:
    /// Throws InputError if a burst would last longer than the interval.
    explicit Bursts(const ParameterValues& values);

    [[nodiscard]] Births births(const Step& step) override;
    [[nodiscard]] bool neverEmits() const override { return count_ <= 0; }
    /// Copies the fraction that is due, and the time within the interval if the interval is unchanged.
    void takeOver(const Part& before) override;
    [[nodiscard]] double meanRatePerSecond() const override { return count_ / intervalSeconds_; }

 private:
    [[nodiscard]] double burstsUpTo(double seconds) const;
    /// The inverse: the first time at which this many bursts have passed.
    [[nodiscard]] double momentOf(double bursts) const;

    double count_, durationSeconds_, intervalSeconds_;
    double seconds_ = 0;  ///< of the internal time counter
    double done_ = 0;     ///< G at that time
    double carried_ = 0;  ///< fraction of a particle that is already due
};

Bursts::Bursts(const ParameterValues& values)
    : EmissionPart(values),
      count_(values.real("count")),
      durationSeconds_(values.real("duration_seconds")),
      intervalSeconds_(values.real("interval_seconds")) {
    if (durationSeconds_ > intervalSeconds_)
        throw InputError("parameter duration_seconds: got " + values.canonical().find("duration_seconds")->second +
                         ", allowed: at most interval_seconds, " + values.canonical().find("interval_seconds")->second);
}

void Bursts::takeOver(const Part& before) {
    const auto* bursts = dynamic_cast<const Bursts*>(&before);
    if (!bursts) return;
    carried_ = bursts->carried_;
    if (bursts->intervalSeconds_ != intervalSeconds_) return;
    seconds_ = bursts->seconds_;
    done_ = burstsUpTo(seconds_);
}

double Bursts::burstsUpTo(double seconds) const {
    const double before = std::floor(seconds / intervalSeconds_), within = seconds - before * intervalSeconds_;
    return before + (within < durationSeconds_ ? within / durationSeconds_ : 1.0);
}

double Bursts::momentOf(double bursts) const {
    const double before = std::max(std::ceil(bursts) - 1, 0.0);
    return before * intervalSeconds_ + (bursts - before) * durationSeconds_;
}

Births Bursts::births(const Step& step) {
    const double perPuff = step.fixedRatePerSecond > 0 ? step.fixedRatePerSecond * intervalSeconds_ : count_;
    const double count = perPuff * static_cast<double>(step.particlesPerPuff);
    const double begin = seconds_, doneBefore = done_, carriedBefore = carried_;
    seconds_ += step.seconds;
    done_ = burstsUpTo(seconds_);
    if (count <= 0) return {};
    const double due = carried_ + count * (done_ - doneBefore);
    const double whole = std::floor(due + 1e-6);  // the last particle of a burst must not wait for the next one
    carried_ = due - whole;
    if (whole < 1) return {};
    const auto moment = [&](double k) { return momentOf(doneBefore + (k - carriedBefore) / count) - begin; };
    const double first = std::max(moment(1), 0.0), last = std::clamp(moment(whole), first, step.seconds);
    return {static_cast<std::int64_t>(whole), first, whole > 1 ? (last - first) / (whole - 1) : 0};
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "bursts, with pauses between them";
    info.source = "Thesis, 4.6.2";
    info.parameters.real("count", 700, 0, 1e8, "", "births per burst, from all emitters together")
        .real("duration_seconds", 0.05, 0, 1e4, "s", "duration of a burst; 0: all at once")
        .real("interval_seconds", 2, 1e-3, 1e6, "s",
              "from the start of a burst to the next start; in a step with several bursts, births are evenly "
              "spaced");
    info.create = [](const ParameterValues& values) { return std::make_unique<Bursts>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::emission::bursts
