#include "methods/grid_fluid/emitters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::grid_fluid {
namespace {

/// Mean of `value(i)` over a sufficient sample of the particles.
template <typename Value>
double sampledMean(const Puffs& dust, const Value& value) {
    constexpr std::size_t enough = 4096;
    const std::size_t stride = std::max<std::size_t>(1, dust.size() / enough);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < dust.size(); i += stride, ++count) sum += value(i);
    return count > 0 ? sum / static_cast<double>(count) : 0;
}

enum Stream : std::uint32_t { placesStream = 1, chanceStream };

flow::FluidSource ballOf(const SourceSetup& setup, const glm::dvec3& centre, float strength) {
    flow::FluidSource source;
    source.centreMetres = centre;
    source.radiusMetres = setup.radiusMetres;
    source.densityPerSecond = strength * setup.densityPerSecond;
    source.kelvinPerSecond = strength * setup.kelvinPerSecond;
    source.reaction = std::min(1.0f, strength) * setup.reaction;
    source.velocityMetresPerSecond = setup.velocity;
    source.velocityPerSecond = setup.velocityPerSecond;
    return source;
}

}  // namespace

double meanPuffMassSquareMetres(const Puffs& dust) {
    return sampledMean(dust, [&](std::size_t i) {
        return maths::puffMassSquareMetres(static_cast<double>(dust.opacity[i]), static_cast<double>(dust.radius[i]));
    });
}

double meanLifetimeSeconds(const Puffs& dust) {
    return sampledMean(dust, [&](std::size_t i) { return static_cast<double>(dust.lifetime[i]); });
}

std::size_t bornWithin(const Puffs& dust, double stepSeconds) {
    const auto step = static_cast<float>(stepSeconds);
    std::size_t born = 0;
    for (const float age : dust.age) born += age < step ? 1u : 0u;
    return born;
}

Emitters::Emitters(const std::vector<SourceSetup>& setups, const scene::Scene& scene, std::uint64_t seed)
    : setups_(setups), scene_(scene), seed_(seed) {
    for (const SourceSetup& setup : setups_) {
        if (setup.at == SourceAt::point) balls_.push_back({setup.centreMetres, &setup, 0});
        if (setup.at == SourceAt::solid) scatterOver(setup, scene);
        if (setup.at == SourceAt::wheels && !scene.vehicle)
            throw InputError("fluid: has sources at wheels, but scene '" + scene.id + "' has no vehicle");
    }
}

/// Uniform by area: one number picks the triangle, two more the position in it.
void Emitters::scatterOver(const SourceSetup& setup, const scene::Scene& scene) {
    std::vector<std::string> known;
    known.reserve(scene.solids.size());
    for (const scene::Solid& solid : scene.solids) known.push_back(solid.name);
    const auto found = std::ranges::find(known, setup.solid);
    if (found == known.end()) throw unknownName("solid of scene '" + scene.id + "'", setup.solid, known);
    const auto which = static_cast<std::size_t>(found - known.begin());
    const scene::Mesh& mesh = *scene.solids[which].mesh;
    const glm::dmat4 toWorld(scene.solidPoses[which].toWorld);
    const auto corner = [&](std::size_t index) {
        return glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[index]], 1));
    };
    std::vector<double> areas;
    double whole = 0;
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const glm::dvec3 a = corner(t);
        areas.push_back(whole += 0.5 * glm::length(glm::cross(corner(t + 1) - a, corner(t + 2) - a)));
    }
    if (!(whole > 0))
        throw InputError("fluid: solid '" + setup.solid + "' has no surface, allowed: a solid of triangles");
    for (int n = 0; n < setup.balls; ++n) {
        const auto random = maths::uniform4(seed_, placesStream, static_cast<std::uint64_t>(n));
        const auto chosen = std::ranges::upper_bound(areas, whole * static_cast<double>(random[0]));
        const std::size_t t = 3 * static_cast<std::size_t>(std::min(chosen, areas.end() - 1) - areas.begin());
        const double root = std::sqrt(static_cast<double>(random[1])), along = static_cast<double>(random[2]);
        const glm::dvec3 weights(1 - root, root * (1 - along), root * along);
        const glm::dvec3 place = weights.x * corner(t) + weights.y * corner(t + 1) + weights.z * corner(t + 2);
        Ball& ball = balls_.emplace_back(Ball{place, &setup, random[3]});
        if (scene.solids[which].motion != scene::SolidMotion::still) ball.place = Place{which, t, weights};
    }
}

glm::dvec3 Emitters::centreOf(const Ball& ball, const scene::SceneState& state) const {
    if (!ball.place) return ball.centre;
    const scene::Mesh& mesh = scene::solidMesh(scene_, state, ball.place->solid);
    const glm::dmat4 toWorld(scene::solidPose(scene_, state, ball.place->solid).toWorld);
    glm::dvec3 place(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3& corner = mesh.positions[mesh.indices[ball.place->first + k]];
        place += ball.place->weights[static_cast<int>(k)] * glm::dvec3(toWorld * glm::dvec4(corner, 1));
    }
    return place;
}

std::span<const flow::FluidSource> Emitters::at(const scene::SceneState& state, std::int64_t step, double stepSeconds,
                                                double dustM2) {
    sources_.clear();
    for (std::size_t n = 0; n < balls_.size(); ++n) {
        const Ball& ball = balls_[n];
        const SourceSetup& setup = *ball.setup;
        const double turns =
            state.timeSeconds / static_cast<double>(setup.swingSeconds) + static_cast<double>(ball.phase);
        const auto wave = static_cast<float>(0.5 + 0.5 * std::sin(2 * std::numbers::pi * turns));
        float strength = 1 - setup.swing + setup.swing * wave;
        if (setup.chance > 0) {
            const auto random =
                maths::uniform4(seed_, chanceStream, static_cast<std::uint64_t>(step), static_cast<std::uint32_t>(n));
            strength *= 1 + setup.chance * maths::centred(random[0]);
        }
        sources_.push_back(ballOf(setup, centreOf(ball, state), strength));
    }
    for (const SourceSetup& setup : setups_)
        if (setup.at == SourceAt::wheels) addWheels(setup, state, stepSeconds, dustM2);
    return sources_;
}

void Emitters::addWheels(const SourceSetup& setup, const scene::SceneState& state, double stepSeconds, double dustM2) {
    const glm::dvec3 up = state.vehicle.up;
    const double speed = std::abs(state.vehicle.speed);
    if (!(dustM2 > 0)) return;
    for (const scene::WheelState& wheel : state.vehicle.wheels) {
        const glm::dvec3 right = glm::normalize(glm::cross(wheel.forward, up));
        const glm::dvec3 thrown(setup.velocity);
        const double length = glm::length(thrown);
        const double faster = length > 0 ? 1 + static_cast<double>(setup.speedShare) * speed / length : 1;
        const glm::dvec3 velocity = faster * (thrown.x * wheel.forward + thrown.y * up + thrown.z * right) +
                                    static_cast<double>(setup.inherit) * wheel.velocity;
        flow::FluidSource source = ballOf(setup, wheel.contact, 1);
        source.amountM3PerSecond =
            static_cast<float>(dustM2 / static_cast<double>(state.vehicle.wheels.size()) / stepSeconds);
        source.velocityMetresPerSecond = glm::vec3(velocity);
        sources_.push_back(source);
    }
}

}  // namespace dustbench::grid_fluid
