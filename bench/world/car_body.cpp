// The hatchback's body: two lofts along X (lower body, cabin) with superellipse sections, and details on top of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "bench/world/car_model.h"
#include "bench/world/surface_builder.h"

namespace dustbench::world {
namespace {

using glm::vec2;
using glm::vec3;

constexpr vec3 glassColour{0.012f, 0.016f, 0.020f};
constexpr vec3 blackPlastic{0.016f, 0.016f, 0.018f};
constexpr vec3 chassisColour{0.010f, 0.010f, 0.011f};
constexpr vec3 lampGlass{0.95f, 0.93f, 0.85f};
constexpr vec3 rallyLamp{0.95f, 0.80f, 0.25f};
constexpr vec3 tailRed{0.45f, 0.008f, 0.008f};
constexpr vec3 indicator{0.80f, 0.22f, 0.01f};
constexpr vec3 plateWhite{0.80f, 0.80f, 0.78f};
constexpr vec3 silver{0.45f, 0.46f, 0.48f};

constexpr float rearEnd = -0.75f;
constexpr float noseBehindFront = 0.80f;  ///< front overhang, from the front axle
constexpr float sill = 0.20f;
constexpr float beltLine = 0.90f;
constexpr float shoulder = 0.58f;     ///< section coordinate where the side ends
constexpr float hairline = 2e-5f;     ///< between the sections before and behind an arch's end
constexpr float stripeEdge = 0.975f;  ///< section coordinate of the stripe's edge on bonnet and roof

/// A curve through points with increasing x: cubic Hermite with harmonic-mean slopes, so it never overshoots.
float curve(std::span<const vec2> points, float x) {
    if (x <= points.front().x) return points.front().y;
    if (x >= points.back().x) return points.back().y;
    const auto chord = [&](std::size_t i) { return (points[i + 1].y - points[i].y) / (points[i + 1].x - points[i].x); };
    const auto slope = [&](std::size_t i) {
        if (i == 0 || i + 1 == points.size()) return 0.0f;
        const float before = chord(i - 1), after = chord(i);
        return before * after <= 0 ? 0.0f : 2 * before * after / (before + after);
    };
    std::size_t i = 0;
    while (x > points[i + 1].x) ++i;
    const float width = points[i + 1].x - points[i].x;
    const float t = (x - points[i].x) / width;
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * points[i].y + (t3 - 2 * t2 + t) * width * slope(i) +
           (3 * t2 - 2 * t3) * points[i + 1].y + (t3 - t2) * width * slope(i + 1);
}

/// A quarter of a superellipse |z|ⁿ + |y|ⁿ = 1 from (z 1, y 0) to (z 0, y 1), parametrised evenly in height up to
/// `bend`, then evenly in angle.
vec2 superellipse(float q, float n, float bend) {
    constexpr float sideShare = 0.55f;  // of q, for the side
    const float quarter = std::numbers::pi_v<float> / 2;
    const float bendAngle = std::asin(std::pow(bend, n / 2));
    const float angle = q < sideShare ? std::asin(std::pow(bend * q / sideShare, n / 2))
                                      : bendAngle + (quarter - bendAngle) * (q - sideShare) / (1 - sideShare);
    return {std::pow(std::max(0.0f, std::cos(angle)), 2 / n), std::pow(std::sin(angle), 2 / n)};
}

/// Dimensions of one car, and its two lofts: position over x (along the car) and q (0 at the bottom, 1 on the centre
/// line).
class Shape {
 public:
    explicit Shape(const scene::VehicleParameters& parameters)
        : frontAxle_(static_cast<float>(parameters.wheelbaseMetres)),
          wheelRadius_(static_cast<float>(parameters.wheelRadiusMetres)),
          halfWidth_(static_cast<float>(parameters.trackMetres + parameters.wheelWidthMetres) / 2 + 0.002f) {}

    [[nodiscard]] float nose() const { return frontAxle_ + noseBehindFront; }
    [[nodiscard]] float frontAxle() const { return frontAxle_; }
    [[nodiscard]] float halfWidth() const { return halfWidth_; }
    [[nodiscard]] float archRadius() const { return wheelRadius_ + 0.075f; }

    /// The body is designed for a wheelbase of 2.6 m and stretched between the axles.
    [[nodiscard]] float stretched(float x) const {
        const float shift = frontAxle_ - 2.6f;
        return x <= 0 ? x : x >= 2.6f ? x + shift : x * frontAxle_ / 2.6f;
    }
    [[nodiscard]] float designed(float x) const {
        return x <= 0 ? x : x >= frontAxle_ ? x - frontAxle_ + 2.6f : x * 2.6f / frontAxle_;
    }

    /// Lower edge of the side: the sill, cut out over the wheels.
    [[nodiscard]] float lowerEdge(float x) const {
        for (const float axle : {0.0f, frontAxle_}) {
            const float away = std::abs(x - axle);
            if (away < archRadius()) return wheelRadius_ + std::sqrt(archRadius() * archRadius() - away * away);
        }
        return sill;
    }

    [[nodiscard]] float bodyTop(float x) const {
        static constexpr std::array<vec2, 14> top{{{-0.75f, 0.78f},
                                                   {-0.73f, 0.86f},
                                                   {-0.68f, 0.92f},
                                                   {-0.55f, 0.955f},
                                                   {-0.2f, 0.97f},
                                                   {1.0f, 0.965f},
                                                   {2.0f, 0.975f},
                                                   {2.3f, 0.955f},
                                                   {2.8f, 0.90f},
                                                   {3.1f, 0.845f},
                                                   {3.25f, 0.795f},
                                                   {3.34f, 0.735f},
                                                   {3.39f, 0.67f},
                                                   {3.40f, 0.62f}}};
        return curve(top, designed(x));
    }

    [[nodiscard]] float bodyHalfWidth(float x) const {
        const float toNose = std::clamp((designed(x) - 2.85f) / 0.55f, 0.0f, 1.0f);
        const float toTail = std::clamp((-0.3f - x) / 0.45f, 0.0f, 1.0f);
        float flare = 0;
        for (const float axle : {0.0f, frontAxle_}) {
            const float away = (x - axle) / 0.52f;
            flare = std::max(flare, 0.028f * std::exp(-away * away * away * away));
        }
        return (halfWidth_ - 0.012f + flare) * (1 - 0.26f * std::pow(toNose, 2.4f)) *
               (1 - 0.13f * std::pow(toTail, 2.2f));
    }

    /// Right side of the lower body.
    [[nodiscard]] vec3 body(float x, float q) const {
        const vec2 section = superellipse(q, 5, 0.86f);
        const float tuck = 1 - 0.05f * (1 - section.y) * (1 - section.y);
        return {x, sill + (bodyTop(x) - sill) * section.y, bodyHalfWidth(x) * section.x * tuck};
    }
    /// The q at which the side of the body has height y.
    [[nodiscard]] float bodyAtHeight(float x, float y) const {
        float low = 0, high = 1;
        for (int i = 0; i < 24; ++i) {
            const float middle = (low + high) / 2;
            (body(x, middle).y < y ? low : high) = middle;
        }
        return (low + high) / 2;
    }
    [[nodiscard]] vec3 bodyNormal(float x, float q) const {
        constexpr float step = 0.012f;
        const float q0 = std::max(q - step, 0.0f), q1 = std::min(q + step, 1.0f);
        const float x0 = std::max(x - step, rearEnd), x1 = std::min(x + step, nose());
        const vec3 normal = glm::cross(body(x1, q) - body(x0, q), body(x, q1) - body(x, q0));
        return glm::normalize(normal);
    }

    /// Right side of the cabin, from the belt line up.
    [[nodiscard]] vec3 cabin(float x, float q) const {
        static constexpr std::array<vec2, 12> roof{{{-0.66f, 0.93f},
                                                    {-0.60f, 1.02f},
                                                    {-0.36f, 1.30f},
                                                    {-0.27f, 1.375f},
                                                    {-0.10f, 1.412f},
                                                    {0.4f, 1.445f},
                                                    {0.8f, 1.45f},
                                                    {1.2f, 1.435f},
                                                    {1.42f, 1.40f},
                                                    {1.56f, 1.345f},
                                                    {2.30f, 0.955f},
                                                    {2.36f, 0.93f}}};
        static constexpr std::array<vec2, 5> width{
            {{-0.66f, 0.68f}, {-0.1f, 0.765f}, {0.9f, 0.785f}, {1.7f, 0.765f}, {2.36f, 0.70f}}};
        const float along = designed(x);
        const vec2 section = superellipse(q, 6, 0.90f);
        const float height = (curve(roof, along) - beltLine) * section.y;
        const float scale = halfWidth_ / 0.887f;
        const float z = curve(width, along) * scale * section.x * (1 - 0.40f * height);  // tumblehome
        // The screens are curved in plan: the windscreen's edges lie further back, the rear screen's further forward.
        const float bow = z * z *
                          (along > 1.4f    ? -0.16f * std::min(1.0f, (along - 1.4f) / 0.3f)
                           : along < -0.2f ? 0.10f * std::min(1.0f, (-0.2f - along) / 0.2f)
                                           : 0.0f);
        return {x + bow, beltLine + height, z};
    }

 private:
    float frontAxle_, wheelRadius_, halfWidth_;
};

void sortLines(std::vector<float>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end(), [](float a, float b) { return b - a < 1e-5f; }),
                 values.end());
}

/// Stations along the body, finer around the wheel arches and at the ends; a run ends where the lower edge jumps to an
/// arch.
std::vector<std::vector<float>> bodyStations(const Shape& shape) {
    std::vector<float> stations{rearEnd, -0.735f, -0.70f, -0.64f, -0.54f};
    for (const float axle : {0.0f, shape.frontAxle()}) {
        for (int degrees = 0; degrees <= 180; degrees += 15)
            stations.push_back(axle - shape.archRadius() *
                                          std::cos(static_cast<float>(degrees) * std::numbers::pi_v<float> / 180));
        stations.push_back(axle - shape.archRadius() - hairline);
        stations.push_back(axle + shape.archRadius() + hairline);
    }
    for (const float x : {0.75f, 1.1f, 1.45f, 1.8f}) stations.push_back(shape.stretched(x));
    for (const float x : {3.08f, 3.17f, 3.25f, 3.31f, 3.355f, 3.38f, 3.395f, 3.40f})
        stations.push_back(shape.stretched(x));
    sortLines(stations);
    std::vector<std::vector<float>> runs(1);
    for (const float x : stations) {
        if (!runs.back().empty() && x - runs.back().back() < 2 * hairline) runs.emplace_back();
        runs.back().push_back(x);
    }
    return runs;
}

void addLowerBody(SurfaceBuilder& builder, const Shape& shape, const CarColours& colours) {
    const std::vector<float> rows{0, 0.05f, 0.17f, 0.32f, 0.47f, 0.58f, 0.66f, 0.74f, 0.82f, 0.90f, stripeEdge, 1};
    // Rows up to the shoulder share the part of the section above the wheel arch; rows above keep their place.
    const auto q = [&](float x, float t) {
        const float low = std::min(shape.bodyAtHeight(x, shape.lowerEdge(x)), 0.9f * shoulder);
        return t < shoulder ? low + (shoulder - low) * t / shoulder : t;
    };
    const auto colour = [&](float x, float t) {
        const float along = shape.designed(x);
        const float height = shape.body(x, q(x, t)).y;
        if (t < 0.05f) return blackPlastic;                                           // sill and arch lips
        if ((along > 3.0f || along < -0.41f) && height < 0.46f) return blackPlastic;  // bumpers
        if (t > stripeEdge && along > 2.2f) return colours.stripe;
        return colours.paint;
    };
    const float inner = shape.halfWidth() - 0.36f;
    for (const std::vector<float>& xs : bodyStations(shape)) {
        builder.patch(
            xs, rows, [&](float x, float t) { return shape.body(x, q(x, t)); },
            [&](float x, float t) { return shape.bodyNormal(x, q(x, t)); }, colour);
        // Inwards from the lower edge: wheel wells and floor.
        builder.facets(
            xs, std::array{0.0f, 1.0f},
            [&](float x, float v) {
                const vec3 edge = shape.body(x, q(x, 0));
                return v > 0.5f ? edge : vec3(x, edge.y, std::min(inner, edge.z));
            },
            [](float, float) { return chassisColour; });
    }
}

/// The flat ends of the lower body; `u` runs from the centre line (0) to the side (1).
void addEnd(SurfaceBuilder& builder, const Shape& shape, bool front, const CarColours& colours) {
    const float x = front ? shape.nose() : rearEnd;
    const std::vector<float> us{0, 0.32f, 0.58f, 0.64f, 0.97f, 1};
    const std::vector<float> vs{0, 0.20f, 0.36f, 0.46f, 0.52f, 0.74f, 1};
    const auto position = [&](float u, float v) {
        const vec3 edge = shape.body(x, v);
        const float bulge = 0.035f * (1 - u * u) * (1 - 0.5f * std::abs(2 * v - 1));
        return vec3(x + (front ? bulge : -bulge), edge.y, edge.z * u);
    };
    const auto colour = [&](float u, float v) {
        const float height = position(u, v).y;
        if (front) {
            if (v > 0.46f && height > 0.5f && u < 0.97f) return blackPlastic;  // upper grille
            if (height < 0.46f) return u < 0.64f && v > 0.20f ? chassisColour : blackPlastic;
            return colours.paint;
        }
        if (u < 0.32f && v > 0.36f && v < 0.52f) return plateWhite;
        if (height < 0.44f) return blackPlastic;
        if (u > 0.64f && v > 0.36f && v < 0.52f) return v > 0.46f ? tailRed : indicator;
        return colours.paint;
    };
    // The outside faces forward at the front and backward at the rear, so u runs in opposite directions.
    if (front) {
        const std::vector<float> reversed(us.rbegin(), us.rend());
        builder.patch(reversed, vs, position, colour);
    } else {
        builder.patch(us, vs, position, colour);
    }
}

void addCabin(SurfaceBuilder& builder, const Shape& shape, const CarColours& colours) {
    std::vector<float> xs;
    for (const float x : {-0.66f, -0.60f, -0.48f, -0.36f, -0.31f, -0.27f, -0.20f, -0.08f, 0.05f, 0.45f, 0.86f, 0.96f,
                          1.2f,   1.36f,  1.46f,  1.54f,  1.62f,  1.8f,   1.95f,  2.10f,  2.24f, 2.30f, 2.36f})
        xs.push_back(shape.stretched(x));
    const std::vector<float> rows{0, 0.09f, 0.28f, 0.48f, 0.55f, 0.63f, 0.70f, 0.78f, 0.88f, stripeEdge, 1};
    const auto colour = [&](float x, float q) {
        const float along = shape.designed(x);
        const bool centre = q > 0.63f, side = q > 0.09f && q < 0.48f;
        if (centre && along > 1.54f && along < 2.30f) return glassColour;    // windscreen
        if (centre && along < -0.31f && along > -0.60f) return glassColour;  // rear screen
        if (side && along > 0.96f && along < 1.95f) return glassColour;
        if (side && along > -0.08f && along < 0.86f) return glassColour;
        if (q > stripeEdge && along > -0.31f && along < 1.54f) return colours.stripe;
        return colours.paint;
    };
    builder.patch(
        xs, rows, [&](float x, float q) { return shape.cabin(x, q); }, colour);
}

/// Details on the right side of the lower body, `lift` above its surface.
class Decals {
 public:
    Decals(SurfaceBuilder& builder, const Shape& shape) : builder_(builder), shape_(shape) {}

    void rectangle(float x0, float x1, float y0, float y1, int cells, const vec3& colour, float lift = 0.009f) {
        const std::vector<float> xs = lines(shape_.stretched(x0), shape_.stretched(x1), cells);
        builder_.patch(
            xs, lines(0, 1, 5), [&](float x, float v) { return lifted(x, y0 + (y1 - y0) * v, lift); },
            [&](float x, float v) { return shape_.bodyNormal(x, shape_.bodyAtHeight(x, y0 + (y1 - y0) * v)); },
            [&](float, float) { return colour; });
    }
    void disc(float x, float y, float radius, const vec3& colour) {
        const float middle = shape_.stretched(x);
        builder_.patch(
            std::array{0.0f, 1.0f}, lines(0, 2 * std::numbers::pi_v<float>, 18),
            [&](float u, float angle) {
                return lifted(middle + u * radius * std::cos(angle), y + u * radius * std::sin(angle), 0.005f);
            },
            [&](float u, float angle) {
                const float along = middle + u * radius * std::cos(angle);
                return shape_.bodyNormal(along, shape_.bodyAtHeight(along, y + u * radius * std::sin(angle)));
            },
            [&](float, float) { return colour; });
    }

 private:
    [[nodiscard]] vec3 lifted(float x, float y, float lift) const {
        const float held = std::clamp(x, rearEnd, shape_.nose());
        const float q = shape_.bodyAtHeight(held, y);
        return shape_.body(held, q) + lift * shape_.bodyNormal(held, q);
    }

    SurfaceBuilder& builder_;
    const Shape& shape_;
};

void addSideDetails(SurfaceBuilder& builder, const Shape& shape, const CarColours& colours) {
    Decals decals(builder, shape);
    decals.rectangle(3.14f, 3.375f, 0.60f, 0.725f, 10, lampGlass);  // headlamp round the corner
    decals.rectangle(3.09f, 3.135f, 0.62f, 0.715f, 1, indicator);
    decals.rectangle(-0.742f, -0.56f, 0.63f, 0.83f, 4, tailRed);              // tail lamp
    decals.rectangle(2.02f, 2.032f, 0.30f, 0.88f, 1, chassisColour, 0.006f);  // door seams
    decals.rectangle(0.905f, 0.917f, 0.30f, 0.88f, 1, chassisColour, 0.006f);
    decals.rectangle(0.30f, 0.312f, 0.62f, 0.88f, 1, chassisColour, 0.006f);
    decals.rectangle(1.00f, 1.15f, 0.785f, 0.81f, 1, blackPlastic, 0.014f);  // handles
    decals.rectangle(0.36f, 0.50f, 0.785f, 0.81f, 1, blackPlastic, 0.014f);
    decals.disc(1.47f, 0.58f, 0.18f, colours.stripe);  // start number's plate
    // Mirror, mud flaps.
    builder.box({shape.stretched(1.90f), 1.0f, shape.halfWidth() - 0.015f}, {0.035f, 0.05f, 0.09f}, colours.paint);
    for (const float axle : {0.0f, shape.frontAxle()})
        builder.box({axle - shape.archRadius() - 0.02f, 0.21f, shape.halfWidth() - 0.13f}, {0.008f, 0.10f, 0.11f},
                    tailRed);
    // Lamps on the nose.
    builder.lamp({shape.nose() + 0.10f, 0.66f, 0.17f}, 0.095f, 0.09f, true, rallyLamp, blackPlastic);
    builder.lamp({shape.nose() + 0.085f, 0.66f, 0.40f}, 0.095f, 0.09f, true, rallyLamp, blackPlastic);
}

void addCentreDetails(SurfaceBuilder& builder, const Shape& shape, const CarColours& colours) {
    const float nose = shape.nose(), axle = shape.frontAxle();
    // Chassis visible between the wheels.
    builder.box({axle / 2 + 0.05f, 0.46f, 0}, {axle / 2 + 0.66f, 0.25f, shape.halfWidth() - 0.36f}, chassisColour);
    builder.box({nose + 0.045f, 0.34f, 0}, {0.012f, 0.055f, 0.26f}, plateWhite);
    builder.box({nose - 0.04f, 0.205f, 0}, {0.09f, 0.012f, 0.62f}, blackPlastic);                 // lip
    builder.box({-0.36f, 1.405f, 0}, {0.15f, 0.018f, 0.50f}, colours.paint);                      // roof spoiler
    builder.box({shape.stretched(1.18f), 1.475f, 0}, {0.14f, 0.035f, 0.17f}, blackPlastic);       // roof scoop
    builder.lamp({rearEnd - 0.06f, 0.25f, -0.42f}, 0.045f, 0.16f, false, chassisColour, silver);  // exhaust
}

}  // namespace

scene::Mesh carBody(const scene::VehicleParameters& parameters, const CarColours& colours) {
    const Shape shape(parameters);
    SurfaceBuilder builder;
    addLowerBody(builder, shape, colours);
    addEnd(builder, shape, true, colours);
    addEnd(builder, shape, false, colours);
    addCabin(builder, shape, colours);
    addSideDetails(builder, shape, colours);
    builder.mirror(0, 0);
    addCentreDetails(builder, shape, colours);
    return builder.finish();
}

}  // namespace dustbench::world
