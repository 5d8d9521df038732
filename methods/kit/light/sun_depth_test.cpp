#include "methods/kit/light/sun_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::light {
namespace {

using particles::ParticleStore;

ParticleStore ball(MemoryLedger& ledger, std::uint64_t seed, std::size_t count, glm::vec3 middle, float metres) {
    ParticleStore store(ledger);
    store.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = maths::uniform4(seed, 1, i), b = maths::uniform4(seed, 2, i);
        store.x[i] = middle.x + metres * maths::centred(a[0]);
        store.y[i] = middle.y + metres * maths::centred(a[1]);
        store.z[i] = middle.z + metres * maths::centred(a[2]);
        store.radius[i] = 0.25f + 1.35f * b[0];
        store.opacity[i] = 0.5f * b[1];
    }
    return store;
}

double plainDepth(const ParticleStore& store, const glm::dvec3& toSun, const glm::dvec3& at, double share,
                  const std::vector<std::uint32_t>& indices) {
    double sum = 0;
    for (const std::uint32_t i : indices) {
        const glm::dvec3 toCentre = glm::dvec3(store.position(i)) - at;
        const double foot = glm::dot(toCentre, glm::normalize(toSun));
        const double b = glm::length(glm::cross(toCentre, glm::normalize(toSun)));
        sum += share * maths::rayOpticalDepth(static_cast<double>(store.opacity[i]),
                                              static_cast<double>(store.radius[i]), b, foot, 0, 1e9);
    }
    return sum;
}

TEST(SunDepth, EqualsTheClosedFormPuffByPuff) {
    MemoryLedger ledger;
    const ParticleStore store = ball(ledger, 6, 300, {20, 1, -7}, 6);
    std::vector<std::uint32_t> all, odd;
    for (std::uint32_t i = 0; i < 300; ++i) (i % 2 ? odd : all).push_back(i);
    all.insert(all.end(), odd.begin(), odd.end());
    for (const glm::dvec3 toSun : {glm::dvec3(0, 1, 0), glm::dvec3(-0.93, 0.26, -0.25), glm::dvec3(0, 0, -3)}) {
        const SunDepth sun(store, toSun, 0.5, 1e-9), ofOdd(store, toSun, 0.5, 1e-9, odd);
        for (std::uint64_t k = 0; k < 300; ++k) {
            const auto a = maths::uniform4(6, 9, k);
            const glm::dvec3 at = glm::dvec3(20, 1, -7) +
                                  12.0 * glm::dvec3(maths::centred(a[0]), maths::centred(a[1]), maths::centred(a[2]));
            const double sum = plainDepth(store, toSun, at, 0.5, all),
                         sumOfOdd = plainDepth(store, toSun, at, 0.5, odd);
            ASSERT_NEAR(sun.at(at), sum, 3e-7 + 4e-9 * sum);
            ASSERT_NEAR(ofOdd.at(at), sumOfOdd, 3e-7 + 4e-9 * sumOfOdd);
        }
    }
}

TEST(SunDepth, APuffWithoutAPlaceDoesNotCount) {
    MemoryLedger ledger;
    ParticleStore store = ball(ledger, 6, 20, {0, 0, 0}, 3);
    const double before = SunDepth(store, {0, 1, 0}, 1, 1e-9).at({0, -2, 0});
    store.resize(22);
    for (const std::size_t i : {20u, 21u}) store.radius[i] = 1, store.opacity[i] = 0.5f;
    store.x[20] = std::nanf("");
    store.z[21] = INFINITY;
    EXPECT_EQ(SunDepth(store, {0, 1, 0}, 1, 1e-9).at({0, -2, 0}), before);
}

TEST(SunDepth, NeedsADirectionAndIsZeroWithoutPuffs) {
    MemoryLedger ledger;
    EXPECT_EQ(SunDepth(ParticleStore(ledger), {0, 1, 0}, 1, 1e-9).at({1, 2, 3}), 0);
    EXPECT_THROW(SunDepth(ParticleStore(ledger), {0, 0, 0}, 1, 1e-9), std::invalid_argument);
    EXPECT_THROW(SunDepth(ParticleStore(ledger), {0, std::nan(""), 0}, 1, 1e-9), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::light
