#include "methods/kit/particles_gl/step_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "methods/kit/maths/bezier.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/maths/turbulence.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles {
namespace {

/// The kinds of parts.glsl.
enum SourceKind : std::uint32_t { pointSource, discSource, rectangleSource, lineSource, ballSource };
enum VelocityKind : std::uint32_t { coneVelocity, randomVelocity, fixedVelocity };
enum SizeKind : std::uint32_t { sizeByAge, randomSize };

struct ShadedPart {
    PartKind kind;
    std::string_view name;
};
/// Emission runs on the CPU: it yields a number of births and their times. Render parts only describe the drawing.
constexpr std::array shadedParts{
    ShadedPart{PartKind::position, "point"},     ShadedPart{PartKind::position, "disc"},
    ShadedPart{PartKind::position, "rectangle"}, ShadedPart{PartKind::position, "line"},
    ShadedPart{PartKind::position, "sphere"},    ShadedPart{PartKind::velocity, "cone"},
    ShadedPart{PartKind::velocity, "random"},    ShadedPart{PartKind::velocity, "fixed"},
    ShadedPart{PartKind::colour, "constant"},    ShadedPart{PartKind::colour, "bands"},
    ShadedPart{PartKind::colour, "linear"},      ShadedPart{PartKind::colour, "bezier"},
    ShadedPart{PartKind::size, "constant"},      ShadedPart{PartKind::size, "linear"},
    ShadedPart{PartKind::size, "random"},        ShadedPart{PartKind::life, "lifetime"},
    ShadedPart{PartKind::force, "wind"},         ShadedPart{PartKind::force, "gravity"},
    ShadedPart{PartKind::force, "constant"},     ShadedPart{PartKind::force, "drag"},
    ShadedPart{PartKind::force, "ground"},
};
/// Of those, only with these modes.
struct ShadedMode {
    PartKind kind;
    std::string_view name, mode;
};
constexpr std::array shadedModes{
    ShadedMode{PartKind::position, "sphere", "exact"},
    ShadedMode{PartKind::velocity, "random", "fixed"},
    ShadedMode{PartKind::colour, "bezier", "fixed"},
};

bool hasShader(const Part& part) {
    if (part.kind() == PartKind::emission || part.kind() == PartKind::render) return true;
    return std::ranges::any_of(shadedParts, [&part](const ShadedPart& shaded) {
        return shaded.kind == part.kind() && shaded.name == part.name();
    });
}

float number(const Part& part, const char* name) {
    return static_cast<float>(part.values().real(name));
}

glm::vec4 withW(const glm::vec3& v, float w = 0) {
    return {v, w};
}

glm::uvec2 halves(std::uint64_t value) {
    return {static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(value >> 32)};
}

void setLook(StepValues& values, const PartList& parts, const Step& step) {
    const Part& size = *parts.size();
    if (size.name() == "linear")
        values.radius.x = number(size, "start_metres"),
        values.radius.y = number(size, "end_metres") - number(size, "start_metres");
    else if (size.name() == "random")
        values.kinds.z = randomSize, values.radius.x = number(size, "average_metres"),
        values.radius.y = number(size, "variation_metres");
    else
        values.radius.x = number(size, "radius_metres");
    values.radius.z = static_cast<float>(step.seconds);

    const Part& colour = *parts.colour();
    const float start = number(colour, "opacity_start"), end = number(colour, "opacity_end");
    values.life.z = colour.values().choice("opacity_curve") == "bezier" ? 1.0f : 0.0f;
    if (values.life.z == 1.0f) {
        const auto curve =
            maths::bezierPolynomial(start, number(colour, "opacity_early"), number(colour, "opacity_late"), end);
        values.opacity = {curve.c0, curve.c1, curve.c2, curve.c3};
    } else {
        values.opacity = {start, end - start, 0, 0};
    }
    const auto own = [&](const char* name) { return glm::vec3(vectorOf(colour.values(), name, colourAxes)); };
    if (colour.name() == "linear" || colour.name() == "bezier") {
        values.life.w = 1;
        const glm::vec3 first = own("start"), last = own("end");
        for (int i = 0; i < 3; ++i) {
            values.colourCurves[i] = {first[i], last[i] - first[i], 0, 0};
            if (colour.name() == "linear") continue;
            const auto curve = maths::bezierPolynomial(first[i], own("early")[i], own("late")[i], last[i]);
            values.colourCurves[i] = {curve.c0, curve.c1, curve.c2, curve.c3};
        }
    }
    if (colour.name() != "bands") return;
    values.colours[0] = withW(own("first"), number(colour, "share"));
    values.colours[1] = withW(own("second"));
    values.numbers.z = static_cast<std::uint32_t>(colour.values().integer("births"));
}

void setVelocity(StepValues& values, const Part& velocity) {
    values.launch.x = number(velocity, "speed");
    values.launch.z = number(velocity, "variation");
    if (velocity.name() == "random") {
        values.kinds.y = randomVelocity;
        return;
    }
    if (velocity.name() == "fixed") {
        values.kinds.y = fixedVelocity;
        values.coneFrame[0] = withW(directionOf(velocity.values(), "direction"));
        return;
    }
    const glm::vec3 axis = directionOf(velocity.values(), "direction");
    const maths::Tangents frame = maths::tangentsOf(axis);
    const float turns = static_cast<float>(velocity.values().real("half_angle_degrees") / 360);
    const float half = maths::sineOfTurns(turns / 2);
    const bool printed = velocity.values().choice("mode", samplingModes) == maths::SamplingMode::paper;
    values.cone = {2.0f * half * half, turns, printed ? 1.0f : 0.0f, number(velocity, "inherit")};
    values.coneFrame[0] = withW(frame.first);
    values.coneFrame[1] = withW(frame.second);
    values.coneFrame[2] = withW(axis);
    values.launch.y = number(velocity, "speed_share");
}

/// Returns the directions of the source's extents, in the frame of its emitter.
maths::Tangents setSource(StepValues& values, const Part& position) {
    const std::string& name = position.name();
    maths::Tangents axes{{1, 0, 0}, {0, 0, 1}};  // of a horizontal disc or rectangle
    if (name == "disc" || name == "rectangle")
        if (const glm::vec3 normal = directionOf(position.values(), "normal"); normal != glm::vec3(0, 1, 0))
            axes = maths::tangentsOf(normal);
    if (name == "disc") {
        values.kinds.x = discSource;
        values.source.x = number(position, "radius_metres");
    } else if (name == "rectangle") {
        values.kinds.x = rectangleSource;
        values.source.x = number(position, "length_metres");
        values.source.y = number(position, "width_metres");
    } else if (name == "line") {
        values.kinds.x = lineSource;
        values.source.x = number(position, "length_metres");
        values.source.y = position.values().choice("base") == "middle" ? -0.5f : 0.0f;
        axes.first = directionOf(position.values(), "direction");
    } else if (name == "sphere") {
        values.kinds.x = ballSource;
        values.source.x = number(position, "radius_metres");
    }
    return axes;
}

void setEmitters(StepValues& values, const Part& position, std::span<const Emitter> emitters) {
    if (emitters.size() > maximumEmitters) throw std::logic_error("particles on the GPU: too many emitters");
    values.numbers.y = static_cast<std::uint32_t>(emitters.size());
    const maths::Tangents axes = setSource(values, position);
    for (std::size_t e = 0; e < emitters.size(); ++e) {
        const Emitter& emitter = emitters[e];
        values.from[e] = withW(emitter.from);
        values.to[e] = withW(emitter.to);
        values.velocityFrom[e] = withW(emitter.velocityFrom);
        values.velocityTo[e] = withW(emitter.velocityTo);
        values.forward[e] = withW(emitter.forward, emitter.speed);
        values.up[e] = withW(emitter.up);
        values.right[e] = withW(emitter.right);
        values.sourceFirst[e] = withW(emitter.toWorld(axes.first));
        values.sourceSecond[e] = withW(emitter.toWorld(axes.second));
    }
}

void setWind(glm::vec4* values, const Part& part, const Step& step) {
    const glm::dvec3 wind = part.values().real("factor") * glm::dvec3(step.scene.wind);
    const maths::GustField gusts =
        maths::gustField(part.values().real("gust_speed"), part.values().real("gust_metres"),
                         part.values().real("gust_seconds"), wind, step.state.timeSeconds, step.seed, windStream);
    values[0] = {1, wind.x, wind.y, wind.z};
    for (int j = 0; j < 4; ++j) {
        const auto k = static_cast<std::size_t>(j);
        values[1][j] = gusts.turnsPerMetre[k];
        values[2][j] = gusts.phaseTurns[k];
        values[3][j] = gusts.amplitude[k];
    }
}

/// `values[0].x` is the kind of force, as in parts.glsl.
void setForce(glm::vec4* values, const Part& part, const Step& step) {
    if (part.name() == "wind") return setWind(values, part, step);
    if (part.name() == "gravity") values[0] = {2, number(part, "acceleration"), 0, 0};
    if (part.name() == "constant") {
        const glm::dvec3 force = vectorOf(part.values(), "force", spaceAxes);
        const double mass = part.values().real("mass_kilograms");
        const bool printed = part.values().choice("mode", samplingModes) == maths::SamplingMode::paper;
        const glm::vec3 acceleration = printed ? force * mass : force / mass;
        values[0] = {3, acceleration.x, acceleration.y, acceleration.z};
    }
    if (part.name() == "drag") values[0] = {4, std::min(part.values().real("rate_per_second"), 1 / step.seconds), 0, 0};
    if (part.name() == "ground")
        values[0] = {5, number(part, "lift"), 1 / (1 + part.values().real("friction_per_second") * step.seconds), 0};
}

}  // namespace

std::string partWithoutShader(const PartList& parts) {
    for (const Part* part : parts.all())
        if (!hasShader(*part)) return "the part " + std::string(kindName(part->kind())) + " '" + part->name() + "'";
    for (const Part* part : parts.all())
        for (const ShadedMode& shaded : shadedModes)
            if (shaded.kind == part->kind() && shaded.name == part->name() &&
                part->values().choice("mode") != shaded.mode)
                return "the part " + std::string(kindName(part->kind())) + " '" + part->name() +
                       "' with mode=" + part->values().choice("mode");
    const ParameterValues& life = parts.lifetime().values();
    if (life.real("per_speed") != 0 || vectorOf(life, "per_metre", spaceAxes) != glm::dvec3(0))
        return "a lifetime by speed or place";
    if (parts.forces().size() > maximumForces) return "a list of more than 16 forces";
    return {};
}

bool ownColours(const PartList& parts) {
    const std::string& colour = parts.colour()->name();
    return colour == "bands" || colour == "linear" || colour == "bezier";
}

double longestLifeSeconds(const PartList& parts) {
    const Part& life = parts.lifetime();
    return life.values().real("average_seconds") + life.values().real("variation_seconds");
}

StepValues stepValues(const PartList& parts, const Step& step, const Births& births, std::span<const Emitter> emitters,
                      std::uint64_t firstSerial) {
    StepValues values;
    values.key = {halves(step.seed), halves(firstSerial)};
    values.numbers.x = static_cast<std::uint32_t>(births.count);
    values.numbers.w = static_cast<std::uint32_t>(parts.forces().size());
    values.births = {births.firstSeconds, births.spacingSeconds};
    values.seconds = {step.seconds, 0};
    values.life.x = number(parts.lifetime(), "average_seconds");
    values.life.y = number(parts.lifetime(), "variation_seconds");
    setLook(values, parts, step);
    setVelocity(values, *parts.velocity());
    setEmitters(values, *parts.position(), emitters);
    const scene::Terrain& terrain = step.scene.terrain;
    if (!terrain.isFlat()) {
        values.ground = {terrain.origin().x, terrain.origin().y, terrain.spacingMetres(), 0};
        values.samples = {terrain.columns(), terrain.rows(), 0, 0};
    }
    for (std::size_t force = 0; force < parts.forces().size(); ++force)
        setForce(values.forces + 4 * force, *parts.forces()[force], step);
    return values;
}

}  // namespace dustbench::particles
