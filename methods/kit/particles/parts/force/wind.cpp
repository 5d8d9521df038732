// The scene's wind, with gusts that make a cloud billow. It moves the air; drag transfers the motion to the particles.
//
// The source describes the gusts; maths/turbulence.h states the departures.
#include "methods/kit/maths/turbulence.h"
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::force::wind {
namespace {

void addGusts(std::size_t count, const float* __restrict x, const float* __restrict y, const float* __restrict z,
              float* __restrict airX, float* __restrict airY, float* __restrict airZ, const maths::GustField gusts,
              const glm::vec3 wind) {
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 gust = gusts(x[i], y[i], z[i]);
        airX[i] += wind.x + gust.x;
        airY[i] += wind.y + gust.y;
        airZ[i] += wind.z + gust.z;
    }
}

void addWind(std::size_t count, float* __restrict air, float wind) {
    for (std::size_t i = 0; i < count; ++i) air[i] += wind;
}

class Wind final : public ForcePart {
 public:
    explicit Wind(const ParameterValues& values);

    void begin(const Step& step, const ParticleStore& store) override;
    void blow(Chunk& chunk, const Step& step) const override;

 private:
    double factor_, gustSpeed_, gustMetres_, gustSeconds_;
    glm::vec3 wind_{0};       ///< of this step, m/s
    maths::GustField gusts_;  ///< of this step
};

Wind::Wind(const ParameterValues& values)
    : ForcePart(values),
      factor_(values.real("factor")),
      gustSpeed_(values.real("gust_speed")),
      gustMetres_(values.real("gust_metres")),
      gustSeconds_(values.real("gust_seconds")) {}

void Wind::begin(const Step& step, const ParticleStore&) {
    const glm::dvec3 wind = factor_ * glm::dvec3(step.scene.wind);
    wind_ = glm::vec3(wind);
    gusts_ =
        maths::gustField(gustSpeed_, gustMetres_, gustSeconds_, wind, step.state.timeSeconds, step.seed, windStream);
}

void Wind::blow(Chunk& chunk, const Step&) const {
    if (gustSpeed_ > 0) {
        addGusts(chunk.count, chunk.x, chunk.y, chunk.z, chunk.airX, chunk.airY, chunk.airZ, gusts_, wind_);
        return;
    }
    addWind(chunk.count, chunk.airX, wind_.x);
    addWind(chunk.count, chunk.airY, wind_.y);
    addWind(chunk.count, chunk.airZ, wind_.z);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "the scene's wind, with gusts";
    info.source = "Kraichnan1970, Eq. 7";
    info.parameters.real("factor", 1, -100, 100, "", "factor on the scene's wind")
        .real("gust_speed", 0, 0, 100, "m/s", "root mean square of the gusts; 0: none")
        .real("gust_metres", 4, 0.01, 1e4, "m", "longest wavelength of the gusts")
        .real("gust_seconds", 3, 0.01, 1e4, "s", "period of that wavelength");
    info.create = [](const ParameterValues& values) { return std::make_unique<Wind>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::wind
