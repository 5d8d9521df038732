#include "methods/relief/particles/relief_particles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>

#include "methods/kit/lanes/lanes.h"
#include "methods/kit/meshes/curved_panel.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/relief/surface/surface_hit.h"

namespace dustbench::relief {
namespace {

constexpr std::size_t blockSize = 4096;
constexpr std::size_t fatesTogether = 64;
constexpr float nearEdge = 0.01f;     // texels
constexpr float depthMargin = 1e-5f;  // share of the depth, for the rounding of floats and of blocks

/// Returns the share of the path at which it leaves the plate through a rim or the face; 1 or more if it does not.
double exitShare(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec2& halfSize) {
    double share = HUGE_VAL;
    for (int axis = 0; axis < 2; ++axis)
        if (way[axis] != 0)
            share = std::min(share, (std::copysign(halfSize[axis], way[axis]) - from[axis]) / way[axis]);
    if (way.z > 0) share = std::min(share, -from.z / way.z);
    return std::max(share, 0.0);
}

/// One step of the fixed law for particles between the face and the highest point of the surface, which cannot hit
/// anything: most particles, and the cheapest. Position with age, and velocity, are four lanes each; the results equal
/// those of `moved`.
class OpenSpace {
 public:
    /// `within`: slightly less than half the plate's size; `deepest`: the z above which there is no surface.
    OpenSpace(const StepSettings& settings, const glm::vec2& within, float deepest)
        : stepSeconds_(settings.stepSeconds),
          fall_(lanesOf(settings.gravity * (0.5f * settings.stepSeconds * settings.stepSeconds), 1)),
          pull_(lanesOf(settings.gravity * settings.stepSeconds, 0)),
          low_{-within.x, -within.y, deepest, -endless},
          high_{within.x, within.y, 0, settings.maximumAgeSteps},
          lowBefore_{-endless, -endless, deepest, -endless} {}

    /// Returns false and changes nothing if the particle may leave this space or reaches its maximum age.
    [[gnu::always_inline]] bool step(glm::vec4& place, glm::vec4& velocity) const {
        Float4 from, speed;
        std::memcpy(&from, &place, sizeof from);
        std::memcpy(&speed, &velocity, sizeof speed);
        const Float4 to = from + speed * stepSeconds_ + fall_;
        if (!everyLane((to > low_) & (to < high_) & (from > lowBefore_))) return false;
        speed += pull_;
        std::memcpy(&place, &to, sizeof to);
        std::memcpy(&velocity, &speed, sizeof speed);
        return true;
    }

 private:
    using Float4 = lanes::Float4;
    static constexpr float endless = std::numeric_limits<float>::infinity();

    static Float4 lanesOf(const glm::vec3& v, float w) { return Float4{v.x, v.y, v.z, w}; }
    static bool everyLane(const lanes::Int4& mask) {
        std::uint64_t halves[2];
        std::memcpy(halves, &mask, sizeof mask);
        return (halves[0] & halves[1]) == ~std::uint64_t{0};
    }

    float stepSeconds_;
    Float4 fall_, pull_, low_, high_, lowBefore_;
};

/// Skips whole groups of living particles.
std::size_t firstNotLiving(std::span<const Fate> fates) {
    std::size_t first = 0;
    for (; first + fatesTogether <= fates.size(); first += fatesTogether) {
        unsigned any = 0;
        for (std::size_t i = first; i < first + fatesTogether; ++i) any |= static_cast<unsigned>(fates[i]);
        if (any != 0) break;
    }
    while (first < fates.size() && fates[first] == Fate::lives) ++first;
    return first;
}

}  // namespace

TexelFrame::TexelFrame(const scene::Panel& panel)
    : scale_(panel.relief->columns / panel.sizeMetres.x, panel.relief->rows / panel.sizeMetres.y,
             -1 / panel.depthMetres),
      offset_(0.5 * panel.relief->columns - 0.5, 0.5 * panel.relief->rows - 0.5, 0) {}

glm::dvec3 TexelFrame::normal(const glm::dvec2& slope) const {
    return glm::normalize(glm::dvec3(-slope.x * scale_.x / scale_.z, -slope.y * scale_.y / scale_.z, 1));
}

ReliefParticles::ReliefParticles(const scene::Panel& panel, MemoryLedger& ledger)
    : texels_(panel),
      arrays_(panel),
      places_(ledger.account("relief particles")),
      velocities_(ledger.account("relief particles")),
      looks_(ledger.account("relief particles")),
      serials_(ledger.account("relief particles")),
      fates_(ledger.account("relief particles")),
      hits_(ledger.account("relief particle hits")) {}

void ReliefParticles::add(const Motion& motion, const ParticleLook& look, std::uint64_t serial) {
    places_.emplace_back(motion.place, 0.0f);
    velocities_.emplace_back(motion.velocity, 0.0f);
    looks_.push_back(look);
    serials_.push_back(serial);
}

ArrayMover::ArrayMover(const scene::Panel& panel)
    : panel_(&panel),
      halfSize_(panel.sizeMetres / 2.0),
      texels_(panel),
      within_(halfSize_ * (1 - 1e-6)),
      patchScale_(texels_.toTexels(glm::dvec3(1)) - texels_.toTexels(glm::dvec3(0))),
      patchOffset_(texels_.toTexels(glm::dvec3(0)) + glm::dvec3(1, 1, 0)) {}

/// True if a path certainly stays on the plate and above the surface: both ends are in one block, above its minimum
/// depth.
bool ArrayMover::staysAbove(const glm::vec3& from, const glm::vec3& to, const DepthPyramid& pyramid) const {
    if (!(std::abs(to.x) < within_.x && std::abs(to.y) < within_.y && to.z < 0)) return false;
    // Floats are accurate to a hundredth of a texel: near a border, the patches on both sides are checked.
    const glm::vec3 a = from * patchScale_ + patchOffset_, b = to * patchScale_ + patchOffset_;
    const glm::ivec2 low(glm::max(glm::min(a, b) - nearEdge, glm::vec3(0)));
    const glm::ivec2 high(glm::max(a, b) + nearEdge);
    const auto apart = static_cast<unsigned>((low.x ^ high.x) | (low.y ^ high.y));
    const auto level = static_cast<std::size_t>(std::bit_width(apart));
    if (level >= pyramid.levels().size()) return false;
    return std::max(a.z, b.z) + depthMargin < pyramid.nearestOver(low.x, low.y, level);
}

Motion ArrayMover::movedInRelief(const Motion& old, float ageSteps, const StepSettings& settings) const {
    if (!meshes::isCurved(*panel_)) return moved(settings.law, old, settings.gravity, ageSteps, settings.stepSeconds);
    const glm::dvec3 place(old.place);
    const Motion onPanel{glm::vec3(meshes::fromRelief(*panel_, place)),
                         glm::vec3(meshes::reliefAxes(*panel_, place) * glm::dvec3(old.velocity))};
    const Motion now = moved(settings.law, onPanel, settings.gravity, ageSteps, settings.stepSeconds);
    const glm::dvec3 there = meshes::toRelief(*panel_, glm::dvec3(now.place));
    return {glm::vec3(there), glm::vec3(glm::inverse(meshes::reliefAxes(*panel_, there)) * glm::dvec3(now.velocity))};
}

Fate ArrayMover::advance(glm::vec4& place, glm::vec4& velocity, const DepthMap& surface,
                         const StepSettings& settings) const {
    place.w += 1;
    const glm::dvec3 from(place);
    const Motion now = movedInRelief({glm::vec3(place), glm::vec3(velocity)}, place.w, settings);
    if (settings.pyramid && staysAbove(glm::vec3(place), now.place, *settings.pyramid)) {
        place = glm::vec4(now.place, place.w);
        velocity = glm::vec4(now.velocity, 0);
        return place.w >= settings.maximumAgeSteps ? Fate::gone : Fate::lives;
    }
    const glm::dvec3 way = glm::dvec3(now.place) - from;
    const double exit = exitShare(from, way, halfSize_);
    const double within = std::min(exit, 1.0);
    velocity = glm::vec4(now.velocity, 0);
    if (!std::isfinite(way.x + way.y + way.z)) return Fate::gone;
    const glm::dvec3 start = texels_.toTexels(from), end = texels_.toTexels(from + within * way);
    if (const auto share = firstHit(surface, start, end)) {
        place = glm::vec4(glm::vec3(from + *share * within * way), place.w);
        return Fate::hit;
    }
    place = glm::vec4(now.place, place.w);
    return exit < 1 || place.w >= settings.maximumAgeSteps ? Fate::gone : Fate::lives;
}

/// The z above which there is no surface, with a margin; the face if that is unknown or another law applies.
float ArrayMover::openAbove(const StepSettings& settings) const {
    if (!settings.pyramid || settings.law != MotionLaw::fixed || meshes::isCurved(*panel_)) return 0;
    const float nearest = settings.pyramid->blocks().back() - 2 * depthMargin;
    return std::min(0.0f, nearest / patchScale_.z);
}

void ArrayMover::move(const MovingColumns& columns, const DepthMap& surface, const StepSettings& settings) {
    const OpenSpace space(settings, within_, openAbove(settings));
    parallel::forEachBlock(columns.places.size(), blockSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i)
            columns.fates[i] = space.step(columns.places[i], columns.velocities[i])
                                   ? Fate::lives
                                   : advance(columns.places[i], columns.velocities[i], surface, settings);
    });
}

void ReliefParticles::step(Mover& mover, const DepthMap& surface, const StepSettings& settings) {
    fates_.resize(size());
    mover.move({places_, velocities_, fates_}, surface, settings);
    settle(surface);
}

/// Lists the hits and closes the gaps of particles that ended.
void ReliefParticles::settle(const DepthMap& surface) {
    hits_.clear();
    std::size_t kept = firstNotLiving(fates_);
    for (std::size_t i = kept; i < fates_.size(); ++i) {
        if (fates_[i] == Fate::hit) {
            const glm::dvec3 texels = texels_.toTexels(glm::dvec3(places_[i]));
            hits_.push_back({glm::vec3(texels), glm::vec3(velocities_[i]),
                             glm::vec3(texels_.normal(surface.slopeAt(texels.x, texels.y))), looks_[i], serials_[i]});
        }
        if (fates_[i] != Fate::lives) continue;
        places_[kept] = places_[i];
        velocities_[kept] = velocities_[i];
        looks_[kept] = looks_[i];
        serials_[kept++] = serials_[i];
    }
    places_.resize(kept);
    velocities_.resize(kept);
    looks_.resize(kept);
    serials_.resize(kept);
}

}  // namespace dustbench::relief
