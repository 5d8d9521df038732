// Clouds and scenes for the ground truth's tests and benchmarks, and slow reference implementations.
//
// Units: metres. Frame: world. Threads: pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "bench/reference/camera_rays.h"
#include "methods/contract/volume.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::reference::test {

inline scene::View viewFrom(glm::dvec3 eye, glm::dvec3 target, int width = 26, int height = 19) {
    scene::View view;
    view.width = width;
    view.height = height;
    view.camera.eye = eye;
    view.camera.target = target;
    return view;
}

inline void add(particles::ParticleStore& store, const glm::vec3& position, float radius, float opacity) {
    const std::size_t i = store.size();
    store.resize(i + 1);
    store.serial[i] = 100 + i;
    store.x[i] = position.x;
    store.y[i] = position.y;
    store.z[i] = position.z;
    store.radius[i] = radius;
    store.opacity[i] = opacity;
}

/// `count` puffs in a ball, radii 0.25 to 1.6 m, peak opacities up to `densest`.
inline particles::ParticleStore ball(MemoryLedger& ledger, std::uint64_t seed, std::size_t count, glm::vec3 middle,
                                     float metres, float densest) {
    particles::ParticleStore store(ledger);
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = maths::uniform4(seed, 1, i), b = maths::uniform4(seed, 2, i);
        const glm::vec3 offset(maths::centred(a[0]), maths::centred(a[1]), maths::centred(a[2]));
        add(store, middle + metres * offset, 0.25f + 1.35f * b[0], densest * b[1]);
    }
    store.colourOfAll = {0.75f, 0.6f, 0.45f};
    return store;
}

/// Dust behind a vehicle that has driven along +X to the origin, as made by data/particles/wheel_dust.toml: with age,
/// puffs grow from 0.25 to 1.6 m, fade from 0.25 to 0, spread and rise.
inline particles::ParticleStore trail(MemoryLedger& ledger, std::size_t count, float lengthMetres) {
    particles::ParticleStore store(ledger);
    store.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = maths::uniform4(7, 1, i), b = maths::uniform4(7, 2, i);
        const float age = a[0], rest = 1 - age;
        const float wheel = i % 2 ? 0.78f : -0.78f;
        store.serial[i] = i;
        store.x[i] = -lengthMetres * age + maths::centred(a[1]);
        store.y[i] = 0.1f + a[2] * (0.3f + 1.7f * std::sqrt(age));
        store.z[i] = wheel + maths::centred(a[3]) * (0.2f + 1.5f * age) - 3 * age;
        store.radius[i] = 0.25f + 1.35f * age;
        store.opacity[i] = 0.25f * rest * rest * rest + 3 * 0.07f * rest * rest * age + 3 * 0.025f * rest * age * age;
        store.lifetime[i] = 3 + 2 * b[0];
        store.age[i] = age * store.lifetime[i];
    }
    store.colourOfAll = {0.75f, 0.6f, 0.45f};
    return store;
}

/// Level ground at a given height, up to the horizon.
inline OpaqueDistances groundDistances(const scene::View& view, double height) {
    const CameraRays rays(view);
    OpaqueDistances ground{view.width, view.height, {}};
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double metres = (height - view.camera.eye.y) / rays.direction(x, y).y;
            ground.metres.push_back(metres >= 0 ? metres : std::numeric_limits<double>::infinity());
        }
    return ground;
}

/// Optical depths by maths::rayOpticalDepth for every puff in every pixel: the definition, with nothing neglected.
inline std::vector<double> plainDepths(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                                       double opticalDepthShare = 1) {
    const CameraRays rays(view);
    std::vector<double> depths;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 direction = rays.direction(x, y);
            double sum = 0;
            for (std::size_t i = 0; i < store.size(); ++i) {
                const glm::dvec3 toCentre = glm::dvec3(store.position(i)) - view.camera.eye;
                const double foot = glm::dot(toCentre, direction);
                const double b = glm::length(glm::cross(toCentre, direction));
                sum += opticalDepthShare * maths::rayOpticalDepth(static_cast<double>(store.opacity[i]),
                                                                  static_cast<double>(store.radius[i]), b, foot, 0,
                                                                  distances.metres[depths.size()]);
            }
            depths.push_back(sum);
        }
    return depths;
}

/// The same by brute force, without any closed form: the puffs' extinctions are summed at points along the ray and
/// integrated by Simpson's rule with `perDeviation` steps per smallest s.
inline std::vector<double> marchedDepths(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                                         double perDeviation = 12) {
    const CameraRays rays(view);
    double smallest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const double s = static_cast<double>(store.radius[i]) / 2;
        smallest = std::min(smallest, s);
        farthest = std::max(farthest, glm::length(glm::dvec3(store.position(i)) - view.camera.eye) + 8 * s);
    }
    std::vector<double> depths;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 direction = rays.direction(x, y);
            const double end = std::min(farthest, distances.metres[depths.size()]);
            const auto steps = 2 * static_cast<int>(std::ceil(end / (2 * smallest) * perDeviation) + 1);
            double sum = 0;
            for (int k = 0; k <= steps; ++k) {
                const glm::dvec3 at = view.camera.eye + end * k / steps * direction;
                double extinction = 0;
                for (std::size_t i = 0; i < store.size(); ++i)
                    extinction += maths::puffExtinctionPerMetre(static_cast<double>(store.opacity[i]),
                                                                static_cast<double>(store.radius[i]),
                                                                glm::length(glm::dvec3(store.position(i)) - at));
                sum += extinction * (k == 0 || k == steps ? 1 : k % 2 ? 4 : 2);
            }
            depths.push_back(sum * end / steps / 3);
        }
    return depths;
}

}  // namespace dustbench::reference::test
