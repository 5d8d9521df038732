#include "methods/kit/particles/particle_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>

#include "methods/contract/errors.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/memory/available_memory.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk_update.h"
#include "methods/kit/particles/events.h"
#include "methods/kit/particles/noted_particles.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {
namespace {

constexpr std::size_t fewChunks = 4;  // with fewer chunks, a second thread is not worth it

/// Copies of positions and velocities at the start of a step; empty unless a force settles particles.
class LinkedStart {
 public:
    explicit LinkedStart(MemoryLedger& ledger) : ledger_(ledger) {}

    void take(const ParticleStore& s) {
        const std::array columns{&s.x, &s.y, &s.z, &s.velocityX, &s.velocityY, &s.velocityZ};
        for (std::size_t c = 0; c < columns.size(); ++c) columns_[c].assign(columns[c]->begin(), columns[c]->end());
    }
    [[nodiscard]] StepStart all() const {
        return {columns_[0], columns_[1], columns_[2], columns_[3], columns_[4], columns_[5]};
    }

 private:
    using Column = LedgerVector<float>;
    [[nodiscard]] Column column() const { return Column(ledger_.account("particle starts")); }

    MemoryLedger& ledger_;
    std::array<Column, 6> columns_{column(), column(), column(), column(), column(), column()};
};

ForcePart* settlingPart(const PartList& parts) {
    const auto found = std::ranges::find_if(parts.forces(), [](const auto& force) { return force->settles(); });
    return found == parts.forces().end() ? nullptr : found->get();
}

void addVehicle(maths::Hash& hash, const scene::VehicleState& vehicle) {
    const auto add = [&](const glm::dvec3& v) { hash.add(v.x).add(v.y).add(v.z); };
    add(vehicle.position);
    hash.add(vehicle.heading).add(vehicle.speed).add(vehicle.acceleration).add(vehicle.steerAngle);
    add(vehicle.up);
    for (const scene::WheelState& wheel : vehicle.wheels) {
        add(wheel.hub);
        add(wheel.contact);
        add(wheel.velocity);
        add(wheel.forward);
        hash.add(wheel.steerAngle).add(wheel.spinAngle).add(wheel.spinRate);
    }
}

void addSolids(maths::Hash& hash, const std::vector<scene::SolidNow>& solids) {
    const auto add = [&](const glm::vec3& v) { hash.add(v.x).add(v.y).add(v.z); };
    for (const scene::SolidNow& solid : solids) {
        for (int column = 0; column < 4; ++column) add(glm::vec3(solid.pose.toWorld[column]));
        add(solid.pose.velocity);
        add(solid.pose.angularVelocity);
        if (!solid.shape) continue;
        for (const glm::vec3& position : solid.shape->mesh.positions) add(position);
        for (const glm::vec3& velocity : solid.shape->velocities) add(velocity);
    }
}

}  // namespace

struct ParticleSystem::State {
    State(std::unique_ptr<PartList> list, std::uint64_t seedOfAll) : parts(std::move(list)), seed(seedOfAll) {}

    /// Throws InputError unless the machine's memory suffices for this many particles. Only larger numbers are checked
    /// again.
    void requireRoom(double particles);
    void live(const MetSurfaces& surfaces, const Step& step);
    /// The same with a force that settles particles.
    void liveLinked(ForcePart& settling, const MetSurfaces& surfaces, const Step& step);
    /// Moves the particles if the choice of storage has changed.
    void followStorage();
    void bury(std::span<const std::uint32_t> holes);
    /// Returns the holes that remain.
    [[nodiscard]] std::span<const std::uint32_t> giveBirth(const Births& births, std::span<const Emitter> emitters,
                                                           std::span<const std::uint32_t> holes,
                                                           const MetSurfaces& surfaces, const Step& step);
    void giveBirths(std::span<const std::uint32_t> holes, const MetSurfaces& surfaces, const Step& step);

    std::unique_ptr<PartList> parts;
    std::uint64_t seed;
    std::uint64_t nextSerial = 0;
    double roomFor = 0;  ///< particles for which the last check found memory
    EmitterTracker tracker;
    MemoryLedger ledger;
    ParticleStore store{ledger};
    std::unique_ptr<LinkedParticles> nodes;  ///< null: the store alone holds the particles
    NotedParticles deaths{ledger};
    std::optional<LinkedStart> start;  ///< only if a force settles particles
    EventRecord record;
    /// Births that events of the last step started.
    struct Started {
        std::int64_t count;
        std::vector<Emitter> emitters;
    };
    std::vector<Started> started;
    bool emits = true;
    std::uint32_t steps = 0;
    LedgerVector<std::uint32_t> survivors{ledger.account("particle deaths")};
};

void ParticleSystem::State::requireRoom(double particles) {
    if (particles <= roomFor) return;
    constexpr double maximumCount = 0xffffffff;  // a particle's index has 32 bits
    const std::size_t bytesOfOne = ParticleStore::bytesPerParticle +
                                   (parts->storage() == Storage::array ? 0 : LinkedParticles::bytesPerParticle());
    const double bytes = particles * static_cast<double>(bytesOfOne);
    const std::string asked = fmt::format("{:.0f} particles of a system", particles);
    if (particles > maximumCount)
        throw InputError(
            fmt::format("{} need {:.3g} bytes, allowed: at most {:.0f} particles", asked, bytes, maximumCount));
    const double held = static_cast<double>(store.size()) * static_cast<double>(bytesOfOne);
    requireAvailable(asked, static_cast<std::size_t>(std::max(bytes - held, 0.0)));
    roomFor = particles;
}

void ParticleSystem::State::followStorage() {
    const Storage chosen = parts->storage();
    if (chosen == Storage::array) return nodes.reset();
    const bool pool = chosen == Storage::pool;
    if (nodes && nodes->pool() == pool) return;
    nodes = std::make_unique<LinkedParticles>(ledger, pool);
    nodes->add(store, 0);
}

void ParticleSystem::State::live(const MetSurfaces& surfaces, const Step& step) {
    deaths.prepare(store.size());
    parallel::forEachBlock(
        store.size(), chunkSize,
        [&](std::size_t first, std::size_t count) {
            ChunkScratch scratch;
            Chunk chunk = store.chunk(first, count);
            scratch.lend(chunk, !parts->shadings().empty());
            chunk.hits = record.hitsOfChunk(first / chunkSize);
            updateChunk(chunk, *parts, surfaces, step);
            deaths.note(first / chunkSize, chunk.dead, count);
        },
        fewChunks);
}

void ParticleSystem::State::liveLinked(ForcePart& settling, const MetSurfaces& surfaces, const Step& step) {
    if (!start) start.emplace(ledger);
    start->take(store);
    deaths.prepare(store.size());
    std::vector<std::uint8_t> dead(store.size());
    const auto forEachChunk = [&](const auto& work) {
        parallel::forEachBlock(
            store.size(), chunkSize,
            [&](std::size_t first, std::size_t count) {
                ChunkScratch scratch;
                Chunk chunk = store.chunk(first, count);
                scratch.lend(chunk, !parts->shadings().empty());
                chunk.dead = &dead[first];
                work(chunk);
            },
            fewChunks);
    };
    forEachChunk([&](Chunk& chunk) { advanceChunk(chunk, *parts, step); });
    settling.settle(store, start->all(), {dead, record.hitsOfChunks()}, surfaces, step);
    forEachChunk([&](Chunk& chunk) {
        for (const auto& force : parts->forces()) force->touch(chunk, step);
        deaths.note(chunk.first / chunkSize, chunk.dead, chunk.count);
    });
}

/// Fills the holes (ascending) that no newborn has taken: the last survivors move into them, in order.
void ParticleSystem::State::bury(std::span<const std::uint32_t> holes) {
    if (holes.empty()) return;
    const std::size_t left = store.size() - holes.size();
    const auto firstBeyond = std::ranges::lower_bound(holes, left);
    survivors.clear();
    auto skipped = firstBeyond;
    for (std::size_t i = left; i < store.size(); ++i) {
        if (skipped != holes.end() && *skipped == i)
            ++skipped;
        else
            survivors.push_back(static_cast<std::uint32_t>(i));
    }
    parallel::forEachBlock(
        survivors.size(), chunkSize,
        [&](std::size_t first, std::size_t count) {
            for (std::size_t k = first; k < first + count; ++k) store.move(survivors[k], holes[k]);
        },
        fewChunks);
    store.resize(left);
}

/// Newborns fill the holes of dead particles first, in order; the rest are appended.
std::span<const std::uint32_t> ParticleSystem::State::giveBirth(const Births& births, std::span<const Emitter> emitters,
                                                                std::span<const std::uint32_t> holes,
                                                                const MetSurfaces& surfaces, const Step& step) {
    const std::size_t born = static_cast<std::size_t>(births.count);
    const std::size_t before = store.size();
    requireRoom(static_cast<double>(before) + static_cast<double>(births.count));
    if (born > holes.size()) store.resize(before + born - holes.size());
    record.beginBirths(born, NewbornBlock::size);
    parallel::forEachBlock(
        born, NewbornBlock::size,
        [&](std::size_t first, std::size_t count) {
            ChunkScratch scratch;
            NewbornBlock block;
            Newborns newborns = block.newborns(first, count, nextSerial + first, births, emitters, step.seconds);
            scratch.lend(newborns.chunk, !parts->shadings().empty());
            newborns.chunk.hits = record.hitsOfBlock(first / NewbornBlock::size);
            initialiseNewborns(newborns, *parts, surfaces, step);
            record.noteBirths(first, newborns);
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t k = first + i;
                store.put(newborns.chunk, i, k < holes.size() ? holes[k] : before + (k - holes.size()));
            }
        },
        fewChunks);
    nextSerial += born;
    return holes.subspan(std::min(born, holes.size()));
}

/// Those that events have started come first.
void ParticleSystem::State::giveBirths(std::span<const std::uint32_t> holes, const MetSurfaces& surfaces,
                                       const Step& step) {
    const auto own = parts->position()->emitters(step);
    for (const auto& [count, emitters] : started)
        if (const auto at = emitters.empty() ? own : std::span<const Emitter>(emitters); !at.empty())
            holes = giveBirth({count, 0, 0}, at, holes, surfaces, step);
    started.clear();
    if (!own.empty() && emits) holes = giveBirth(parts->emission()->births(step), own, holes, surfaces, step);
    bury(holes);
}

ParticleSystem ParticleSystem::load(const std::filesystem::path& file, std::uint64_t seed) {
    return ParticleSystem(partsFromFile(file), seed);
}

ParticleSystem::ParticleSystem(std::unique_ptr<PartList> parts, std::uint64_t seed)
    : state_(std::make_unique<State>(std::move(parts), seed)) {
    if (const std::string missing = state_->parts->missing(); !missing.empty())
        throw InputError("particle system: " + missing);
}

ParticleSystem::ParticleSystem(ParticleSystem&&) noexcept = default;
ParticleSystem& ParticleSystem::operator=(ParticleSystem&&) noexcept = default;
ParticleSystem::~ParticleSystem() = default;

void ParticleSystem::update(const Surroundings& surroundings) {
    if (!(surroundings.stepSeconds > 0)) throw std::invalid_argument("ParticleSystem: a step must be longer than 0 s");
    if (surroundings.particlesPerPuff < 1)
        throw std::invalid_argument("ParticleSystem: `particlesPerPuff` must be 1 or more");
    State& s = *state_;
    if (const std::string missing = s.parts->missing(); !missing.empty()) throw std::logic_error(missing);
    const PartList& parts = *s.parts;
    s.followStorage();
    const double fixedRate = static_cast<double>(surroundings.fixedCount) / meanLifetimeSeconds();
    const double rate = fixedRate > 0 ? fixedRate : parts.emission()->meanRatePerSecond();
    s.requireRoom(rate * meanLifetimeSeconds() * static_cast<double>(surroundings.particlesPerPuff));
    const Step step{surroundings.scene,
                    surroundings.state,
                    surroundings.stepSeconds,
                    s.seed,
                    fixedRate,
                    s.tracker.follow(surroundings.scene, surroundings.state, surroundings.stepSeconds),
                    surroundings.particlesPerPuff,
                    parts.position()->lattice(),
                    surroundings.view};

    const auto oneColour = parts.colour()->colourOfAll(step);
    if (oneColour) s.store.colourOfAll = *oneColour;
    s.store.keepOneColour(oneColour.has_value() && parts.shadings().empty());

    for (const auto& force : s.parts->forces()) force->begin(step, s.store);
    for (const auto& life : s.parts->lives()) life->begin(step);
    s.record.begin(parts, step, s.store);
    const MetSurfaces surfaces(parts);
    if (ForcePart* settling = settlingPart(parts))
        s.liveLinked(*settling, surfaces, step);
    else
        s.live(surfaces, step);
    const auto dead = s.deaths.collect();
    s.record.noteMoved(s.store, dead, static_cast<float>(step.seconds));
    if (s.nodes) {
        const std::size_t before = s.store.size();
        s.nodes->bury(s.store, dead);
        s.giveBirths({}, surfaces, step);
        s.nodes->add(s.store, before);
        s.nodes->show(s.store);
    } else {
        s.giveBirths(dead, surfaces, step);
    }
    s.record.end(parts, step.seconds);
    ++s.steps;
}

std::string ParticleSystem::toToml() const {
    return partsToToml(*state_->parts);
}

const ParticleStore& ParticleSystem::store() const {
    return state_->store;
}

PartList& ParticleSystem::parts() {
    return *state_->parts;
}

const PartList& ParticleSystem::parts() const {
    return *state_->parts;
}

void ParticleSystem::replaceParts(std::unique_ptr<PartList> parts) {
    if (const std::string missing = parts->missing(); !missing.empty()) throw InputError("particle system: " + missing);
    parts->takeOver(*state_->parts);
    state_->parts = std::move(parts);
}

double ParticleSystem::meanLifetimeSeconds() const {
    return *state_->parts->lifetime().meanLifetimeSeconds();
}

std::span<const std::vector<Event>> ParticleSystem::events() const {
    return state_->record.events();
}

float ParticleSystem::chanceOf(std::uint64_t serial, std::uint32_t eventPart) const {
    constexpr std::uint32_t partsOfAStep = 64;
    return maths::uniform4(state_->seed, eventStream, serial, partsOfAStep * state_->steps + eventPart)[0];
}

void ParticleSystem::start(std::int64_t count, std::vector<Emitter> emitters) {
    state_->started.push_back({count, std::move(emitters)});
}

void ParticleSystem::emit(bool emits) {
    state_->emits = emits;
}

std::uint64_t ParticleSystem::stateHash() const {
    return state_->store.hash();
}

MemoryReport ParticleSystem::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : state_->ledger.entries()) report.push_back({structure, bytes, 0});
    std::size_t bytesOfForces = 0;
    for (const auto& force : state_->parts->forces()) bytesOfForces += force->bytes();
    if (bytesOfForces > 0) report.push_back({"forces", bytesOfForces, 0});
    return report;
}

std::uint64_t stateHash(const scene::SceneState& state, std::span<const std::uint64_t> systems) {
    maths::Hash hash;
    hash.add(state.timeSeconds);
    addVehicle(hash, state.vehicle);
    addSolids(hash, state.solids);
    for (const std::uint64_t system : systems) hash.add(system);
    return hash.value();
}

}  // namespace dustbench::particles
