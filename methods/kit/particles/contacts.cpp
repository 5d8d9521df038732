#include "methods/kit/particles/contacts.h"

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {
namespace {

/// Distance from the surface after a contact, so that rounding does not put the particle behind it: 1e-6 of the
/// coordinates in the test, eight times their rounding error.
float clearance(const glm::vec3& from, const glm::vec3& to, float extentMetres) {
    const glm::vec3 sum = glm::abs(from) + glm::abs(to);
    return 1e-6f * (sum.x + sum.y + sum.z + extentMetres);
}

/// v ← (1 − friction)·v∥ − restitution·v⊥, relative to the surface.
glm::vec3 reflected(const glm::vec3& v, const glm::vec3& n, const Contact& contact) {
    const float into = std::min(glm::dot(v, n), 0.0f);
    const glm::vec3 across = into * n;
    return (1 - contact.friction) * (v - across) - contact.restitution * across;
}

void lower(std::size_t count, const float* __restrict share, float* __restrict first, std::uint8_t* __restrict by,
           std::uint8_t surface) {
    for (std::size_t i = 0; i < count; ++i) {
        by[i] = share[i] < first[i] ? surface : by[i];
        first[i] = share[i] < first[i] ? share[i] : first[i];
    }
}

/// Finds the first contact of each path.
void meetAll(const Ways& ways, const MetSurfaces& surfaces, float* share, float* first, std::uint8_t* by) {
    std::fill_n(first, ways.count, Surface::none);
    std::fill_n(by, ways.count, std::uint8_t{0});
    std::uint8_t number = 0;
    for (const MetSurface& met : surfaces.all()) {
        met.surface->meet(ways, share);
        lower(ways.count, share, first, by, number++);
    }
}

constexpr float never = INFINITY;

struct Way {
    glm::vec3 from, to, velocity;
    float seconds;
    float leftSeconds;
    bool dead = false;
    float endsIn = never;  ///< seconds from the end of the step to a delayed death; may be negative
};

/// The first contact on the rest of a path, or none; `by` receives the surface.
float meetNext(const Way& way, const MetSurfaces& surfaces, std::uint8_t* by) {
    const Ways one{1,         &way.from.x, &way.from.y,  &way.from.z,    &way.to.x,
                   &way.to.y, &way.to.z,   &way.seconds, way.leftSeconds};
    float first = Surface::none;
    *by = 0;
    std::uint8_t number = 0;
    for (const MetSurface& met : surfaces.all()) {
        float share;
        met.surface->meet(one, &share);
        if (share < first) first = share, *by = number;
        ++number;
    }
    return first;
}

/// Moves to the contact at `share` of the path, where the rest of the path starts.
Touch goTo(Way& way, float share, const Surface& surface) {
    const Touch touch = surface.touchAt({way.from, way.to, way.seconds, share, way.leftSeconds});
    way.from = touch.point + clearance(way.from, way.to, surface.extentMetres()) * touch.normal;
    way.seconds *= 1 - share;
    way.to = way.from;
    return touch;
}

/// Ends a path at its point on the surface, which carries it for the rest of the step, until another surface blocks it.
void ride(Way& way, const Touch& touch, const MetSurfaces& surfaces) {
    if (touch.velocity == glm::vec3(0)) return;
    way.to = way.from + way.seconds * touch.velocity;
    std::uint8_t by;
    if (const float share = meetNext(way, surfaces, &by); share <= 1)
        (void)goTo(way, share, *surfaces.all()[by].surface);
}

/// A death at the present contact, or later.
void mourn(Way& way, float delaySeconds) {
    if (delaySeconds > 0)
        way.endsIn = std::min(way.endsIn, delaySeconds - way.seconds - way.leftSeconds);
    else
        way.dead = true;
}

/// Continues from a contact at `share` with surface `by`, and from all later contacts.
void follow(Way& way, float share, std::uint8_t by, const MetSurfaces& surfaces, std::vector<Hit>* hits,
            std::uint64_t serial) {
    for (int contacts = 1; share <= 1; ++contacts) {
        const MetSurface& met = surfaces.all()[by];
        const Touch touch = goTo(way, share, *met.surface);
        if (hits)
            hits->push_back({{touch.point, way.velocity, touch.normal, serial},
                             by + 1,
                             -glm::dot(way.velocity - touch.velocity, touch.normal)});
        way.velocity = touch.velocity + reflected(way.velocity - touch.velocity, touch.normal, met.contact);
        if (met.contact.kills) mourn(way, met.contact.delaySeconds);
        if (way.dead || contacts == maximumContacts) return ride(way, touch, surfaces);
        way.to = way.from + way.seconds * way.velocity;
        share = meetNext(way, surfaces, &by);
    }
}

}  // namespace

void WayBegins::take(const Chunk& chunk, const float* lasting, bool each) {
    std::copy_n(chunk.x, chunk.count, x.data());
    std::copy_n(chunk.y, chunk.count, y.data());
    std::copy_n(chunk.z, chunk.count, z.data());
    if (each)
        std::copy_n(lasting, chunk.count, seconds.data());
    else
        std::fill_n(seconds.data(), chunk.count, *lasting);
}

MetSurfaces::MetSurfaces(const PartList& parts) {
    const auto add = [&](const Surface* surface, const Contact& contact) {
        if (!surface) return;
        if (count_ == maximum)
            throw InputError("particle system: more than " + std::to_string(maximum) + " surfaces, allowed: at most " +
                             std::to_string(maximum) + ", or one mesh with all of them");
        surfaces_[count_++] = {surface, contact};
    };
    for (const auto& force : parts.forces()) add(force->surface(), force->contact());
    for (const auto& life : parts.lives()) add(life->surface(), life->contact());
}

MetSurfaces MetSurfaces::perPartOf(int parts) const {
    MetSurfaces shared = *this;
    for (MetSurface& met : std::span(shared.surfaces_.data(), shared.count_))
        met.contact.friction = 1 - std::pow(1 - met.contact.friction, 1.0f / static_cast<float>(parts));
    return shared;
}

void meetSurfaces(Chunk& chunk, const WayBegins& begins, const MetSurfaces& surfaces, float leftSeconds) {
    alignas(64) std::array<float, chunkSize> share, first;
    alignas(64) std::array<std::uint8_t, chunkSize> by;
    const Ways ways{chunk.count, begins.x.data(), begins.y.data(),       begins.z.data(), chunk.x,
                    chunk.y,     chunk.z,         begins.seconds.data(), leftSeconds};
    meetAll(ways, surfaces, share.data(), first.data(), by.data());
    for (std::size_t i = 0; i < chunk.count; ++i) {
        if (first[i] > 1) continue;
        Way way{ways.from(i),
                ways.to(i),
                {chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]},
                begins.seconds[i],
                leftSeconds};
        follow(way, first[i], by[i], surfaces, chunk.hits, chunk.hits ? chunk.serial[i] : 0);
        chunk.x[i] = way.to.x, chunk.y[i] = way.to.y, chunk.z[i] = way.to.z;
        chunk.velocityX[i] = way.velocity.x, chunk.velocityY[i] = way.velocity.y, chunk.velocityZ[i] = way.velocity.z;
        if (way.dead) chunk.dead[i] = 1;
        if (way.endsIn < never) chunk.lifetime[i] = std::min(chunk.lifetime[i], chunk.age[i] + way.endsIn);
    }
}

}  // namespace dustbench::particles
