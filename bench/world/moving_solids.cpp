#include "bench/world/moving_solids.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace dustbench::world {
namespace {

constexpr std::size_t firstAngle = 3, firstWeight = 6;

std::vector<double> numbersOf(const SolidKey& key) {
    std::vector<double> numbers{key.position.x, key.position.y, key.position.z, key.turn.x, key.turn.y, key.turn.z};
    numbers.insert(numbers.end(), key.weights.begin(), key.weights.end());
    return numbers;
}

glm::dvec3 three(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Whether the last key of a repeating path equals the first.
bool isTheSame(const std::vector<double>& first, const std::vector<double>& last) {
    for (std::size_t n = 0; n < first.size(); ++n) {
        const double off = last[n] - first[n];
        const bool isAngle = n >= firstAngle && n < firstWeight;
        if (std::abs(isAngle ? std::remainder(off, 2 * std::numbers::pi) : off) > 1e-9) return false;
    }
    return true;
}

}  // namespace

glm::dmat4 solidToWorld(const glm::dvec3& position, const glm::dvec3& turn, double scale) {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), position);
    matrix = glm::rotate(matrix, turn.y, {0, 1, 0});
    matrix = glm::rotate(matrix, turn.z, {0, 0, 1});
    matrix = glm::rotate(matrix, turn.x, {1, 0, 0});
    return glm::scale(matrix, glm::dvec3(scale));
}

scene::SolidPose SolidPath::Moment::pose(double scale) const {
    // R = Ry·Rz·Rx: each rate is about its axis, as turned by the rotations after it.
    const glm::dmat4 turnedY = glm::rotate(glm::dmat4(1), turn.y, {0, 1, 0});
    const glm::dmat4 turnedZ = glm::rotate(turnedY, turn.z, {0, 0, 1});
    const glm::dvec3 spin = turnPerSecond.y * glm::dvec3(0, 1, 0) + turnPerSecond.z * glm::dvec3(turnedY[2]) +
                            turnPerSecond.x * glm::dvec3(turnedZ[0]);
    return {glm::mat4(solidToWorld(position, turn, scale)), glm::vec3(velocity), glm::vec3(spin)};
}

SolidPath::SolidPath(const std::vector<SolidKey>& keys, bool repeats) : repeats_(repeats) {
    if (keys.empty()) throw std::invalid_argument("SolidPath: no keys");
    for (const SolidKey& key : keys) {
        if (!keys_.empty() && !(key.seconds > keys_.back().seconds))
            throw std::invalid_argument("SolidPath: times do not ascend");
        keys_.push_back({key.seconds, numbersOf(key), Numbers(firstWeight + key.weights.size(), 0.0)});
        if (keys_.back().numbers.size() != keys_.front().numbers.size())
            throw std::invalid_argument("SolidPath: keys with different numbers of weights");
    }
    if (repeats && (keys_.size() < 2 || !isTheSame(keys_.front().numbers, keys_.back().numbers)))
        throw std::invalid_argument("SolidPath: a path that repeats does not end as it begins");
    findVelocities();
}

/// From one key to the next.
double SolidPath::slopeAfter(std::size_t key, std::size_t number) const {
    const Key &from = keys_[key], &to = keys_[key + 1];
    return (to.numbers[number] - from.numbers[number]) / (to.seconds - from.seconds);
}

/// Velocity of the parabola through a key and its neighbours: v = (h₁·s₀ + h₀·s₁)/(h₀ + h₁); 0 at the ends of a path
/// that does not repeat.
void SolidPath::findVelocities() {
    const std::size_t last = keys_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        const bool isEnd = i == 0 || i == last;
        if (isEnd && !repeats_) continue;
        const std::size_t before = isEnd ? last - 1 : i - 1, after = isEnd ? 0 : i;
        const double h0 = keys_[before + 1].seconds - keys_[before].seconds;
        const double h1 = keys_[after + 1].seconds - keys_[after].seconds;
        for (std::size_t n = 0; n < keys_[i].numbers.size(); ++n)
            keys_[i].perSecond[n] = (h1 * slopeAfter(before, n) + h0 * slopeAfter(after, n)) / (h0 + h1);
    }
}

SolidPath::Moment SolidPath::at(double seconds) const {
    const double begin = keys_.front().seconds, end = keys_.back().seconds;
    if (repeats_) {
        const double since = std::fmod(seconds - begin, end - begin);
        seconds = begin + (since < 0 ? since + (end - begin) : since);
    }
    Numbers value, rate(keys_.front().numbers.size(), 0.0);
    const auto next = std::ranges::upper_bound(keys_, seconds, {}, &Key::seconds);
    if (next == keys_.begin()) {
        value = keys_.front().numbers;
    } else if (next == keys_.end()) {
        value = keys_.back().numbers;
    } else {
        const Key &from = *(next - 1), &to = *next;
        const double h = to.seconds - from.seconds, u = (seconds - from.seconds) / h, w = 1 - u;
        value.resize(rate.size());
        // Cubic Hermite: p = p₀ + u²(3 − 2u)·(p₁ − p₀) + h·u(1 − u)·((1 − u)·v₀ − u·v₁). A path at rest is exactly
        // where its keys are.
        for (std::size_t n = 0; n < value.size(); ++n) {
            const double way = to.numbers[n] - from.numbers[n], v0 = from.perSecond[n], v1 = to.perSecond[n];
            value[n] = from.numbers[n] + u * u * (3 - 2 * u) * way + h * u * w * (w * v0 - u * v1);
            rate[n] = 6 * u * w * way / h + w * (1 - 3 * u) * v0 - u * (2 - 3 * u) * v1;
        }
    }
    const auto weightsOf = [](const Numbers& numbers) { return Numbers(numbers.begin() + firstWeight, numbers.end()); };
    return {three(value, 0), three(value, firstAngle), weightsOf(value),
            three(rate, 0),  three(rate, firstAngle),  weightsOf(rate)};
}

void MovingSolids::add(std::size_t solid, SolidPath path, double scale, std::optional<meshes::MorphMesh> morph) {
    all_.push_back({solid, std::move(path), scale, std::move(morph)});
}

std::vector<scene::SolidNow> MovingSolids::at(const scene::Scene& scene, double seconds) const {
    std::vector<scene::SolidNow> solids;
    if (all_.empty()) return solids;
    for (const scene::SolidPose& pose : scene.solidPoses) solids.push_back({pose, nullptr});
    for (const Moving& moving : all_) {
        const SolidPath::Moment moment = moving.path.at(seconds);
        scene::SolidNow& now = solids[moving.solid];
        now.pose = moment.pose(moving.scale);
        if (moving.morph)
            now.shape = std::make_shared<const scene::DeformedMesh>(
                meshes::deformed(*moving.morph, moment.weights, moment.weightsPerSecond));
    }
    return solids;
}

std::size_t MovingSolids::bytes() const {
    std::size_t bytes = 0;
    for (const Moving& moving : all_) {
        if (!moving.morph) continue;
        for (const std::vector<glm::vec3>& offsets : moving.morph->offsets) bytes += offsets.size() * sizeof(glm::vec3);
    }
    return bytes;
}

}  // namespace dustbench::world
