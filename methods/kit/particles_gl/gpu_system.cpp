#include "methods/kit/particles_gl/gpu_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "gpu_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/sort/scan.h"
#include "methods/kit/particles/step.h"
#include "methods/kit/particles_gl/step_values.h"
#include "particles_gl_shaders.h"

namespace dustbench::particles {
namespace {

namespace shaders = particles_gl_shaders;

constexpr std::size_t wordBytes = sizeof(std::uint32_t);
constexpr std::uint32_t groupThreads = 256, leastCapacity = 4096;
/// Words of the tally (step.glsl), and where the work groups of its parts begin.
constexpr std::size_t tallyWords = 12, burialsWord = 4;
constexpr std::size_t groupsAt = 1 * wordBytes, burialGroupsAt = 5 * wordBytes;

int groupsOf(std::uint64_t elements) {
    return static_cast<int>((elements + groupThreads - 1) / groupThreads);
}

/// A bound on the number of living particles, from the births of as many steps as the longest life lasts.
class BirthLog {
 public:
    explicit BirthLog(double longestLifeSeconds) : longestLifeSeconds_(longestLifeSeconds) {}

    void add(std::uint64_t births, double stepSeconds) {
        births_.push_back(births);
        bound_ += births;
        // Ages are sums of rounded steps: in so many steps, they are wrong by less than a hundredth.
        constexpr double countedSteps = 150'000;
        const double steps = std::ceil(longestLifeSeconds_ / stepSeconds * 1.01) + 2;
        if (steps > countedSteps) return;
        while (static_cast<double>(births_.size()) > steps) {
            bound_ -= births_.front();
            births_.pop_front();
        }
    }
    [[nodiscard]] std::uint64_t bound() const { return bound_; }

 private:
    double longestLifeSeconds_;
    std::deque<std::uint64_t> births_;
    std::uint64_t bound_ = 0;
};

/// The particles' columns and the lists of a step, with room for `capacity` particles.
struct Room {
    Room(gpu::Device& device, std::uint32_t particles, bool coloured)
        : capacity(particles),
          position(column(device, "dust: positions", 3)),
          velocity(column(device, "dust: velocities", 3)),
          life(column(device, "dust: ages", 2)),
          look(column(device, "dust: looks", 2)),
          serial(column(device, "dust: serials", 2)),
          colour(coloured ? column(device, "dust: colours", 3) : gpu::Buffer()),
          numbers(column(device, "dust: deaths", 1)),
          dead(column(device, "dust: deaths", 1)),
          holes(column(device, "dust: deaths", 1)),
          tail(column(device, "dust: deaths", 1)),
          living(column(device, "dust: deaths", 1)),
          survivors(column(device, "dust: deaths", 1)),
          compaction(device, particles) {
        std::vector<std::uint32_t> ascending(particles);
        std::iota(ascending.begin(), ascending.end(), 0u);
        numbers.write(std::span<const std::uint32_t>(ascending));
    }

    void copyColumnsFrom(const Room& other) {
        position.copyFrom(other.position, other.position.bytes());
        velocity.copyFrom(other.velocity, other.velocity.bytes());
        life.copyFrom(other.life, other.life.bytes());
        look.copyFrom(other.look, other.look.bytes());
        serial.copyFrom(other.serial, other.serial.bytes());
        colour.copyFrom(other.colour, other.colour.bytes());
    }

    std::uint32_t capacity;
    gpu::Buffer position, velocity, life, look, serial, colour;
    gpu::Buffer numbers;  ///< 0, 1, 2 …
    gpu::Buffer dead, holes, tail, living, survivors;
    gpu::Compaction compaction;

 private:
    [[nodiscard]] gpu::Buffer column(gpu::Device& device, const char* label, std::size_t words) const {
        return {device, label, capacity * words * wordBytes};
    }
};

gpu::Program dustProgram(gpu::Device& device, const gpu::ShaderFile& file, bool coloured) {
    std::map<std::string, std::string> definitions;
    if (coloured) definitions["COLOURED"] = "";
    return {device,
            file.name,
            {gpu_shaders::philox_glsl, shaders::step_glsl, shaders::random_glsl, shaders::parts_glsl, file},
            definitions};
}

}  // namespace

struct GpuSystem::State {
    State(gpu::Device& onDevice, const PartList& list, std::uint64_t seedOfAll);

    void makeRoom(std::uint64_t particles);
    void giveHeights(const scene::Terrain& terrain);
    void bindColumns() const;
    void run(const StepValues& values);

    gpu::Device& device;
    const PartList& parts;
    std::uint64_t seed;
    bool coloured;
    std::uint64_t nextSerial = 0;
    EmitterTracker tracker;
    BirthLog births;
    glm::vec3 colourOfAll{1};
    MemoryLedger gpuLedger, ledger;
    std::unique_ptr<Room> room;  ///< not std::optional, of which GCC 14 warns falsely
    gpu::Buffer step, tally, deaths, moved, heights;
    gpu::Program advance, count, bear, markTail, bury;
    ParticleStore store{ledger};
    bool isRead = false;  ///< `store` has this step's particles
};

GpuSystem::State::State(gpu::Device& onDevice, const PartList& list, std::uint64_t seedOfAll)
    : device(onDevice), parts(list), seed(seedOfAll), coloured(ownColours(list)), births(longestLifeSeconds(list)) {
    const gpu::LedgerScope booked(device, gpuLedger);
    step = gpu::Buffer(device, "dust: step", sizeof(StepValues));
    tally = gpu::Buffer(device, "dust: tally", tallyWords * wordBytes);
    tally.clear();
    deaths = gpu::Buffer(device, "dust: tally", wordBytes);
    moved = gpu::Buffer(device, "dust: tally", wordBytes);
    advance = dustProgram(device, shaders::advance_comp, coloured);
    count = dustProgram(device, shaders::tally_comp, coloured);
    bear = dustProgram(device, shaders::bear_comp, coloured);
    markTail = dustProgram(device, shaders::tail_comp, coloured);
    bury = dustProgram(device, shaders::bury_comp, coloured);
    makeRoom(leastCapacity);
}

void GpuSystem::State::makeRoom(std::uint64_t particles) {
    if (room && particles <= room->capacity) return;
    const std::uint64_t capacity = std::max(particles, room ? 2 * std::uint64_t{room->capacity} : 0);
    const std::uint64_t allowed = device.maximumStorageBytes() / (3 * wordBytes);
    if (particles > allowed)
        throw InputError(fmt::format("particles on the GPU: got {} particles, allowed: {} (the largest buffer of {})",
                                     particles, allowed, device.info().renderer));
    const gpu::LedgerScope booked(device, gpuLedger);
    const std::unique_ptr<Room> before = std::exchange(room, nullptr);
    room = std::make_unique<Room>(device, static_cast<std::uint32_t>(std::min(capacity, allowed)), coloured);
    if (before) room->copyColumnsFrom(*before);
}

void GpuSystem::State::giveHeights(const scene::Terrain& terrain) {
    if (heights.bytes() > 0) return;
    const gpu::LedgerScope booked(device, gpuLedger);
    const std::vector<float> none{0};
    heights = gpu::Buffer(device, "dust: terrain", std::span<const float>(terrain.isFlat() ? none : terrain.heights()));
}

void GpuSystem::State::bindColumns() const {
    step.bindUniform(0);
    room->position.bindStorage(1);
    room->velocity.bindStorage(2);
    room->life.bindStorage(3);
    room->look.bindStorage(4);
    room->serial.bindStorage(5);
    if (coloured) room->colour.bindStorage(6);
    tally.bindStorage(7);
    heights.bindStorage(8);
}

void GpuSystem::State::run(const StepValues& values) {
    step.write(std::span(&values, 1));
    Room& r = *room;
    bindColumns();
    r.dead.bindStorage(9);
    advance.dispatchIndirect(tally, groupsAt);
    r.compaction.compact(r.numbers, r.dead, tally, r.holes, deaths);

    bindColumns();
    deaths.bindStorage(9);
    count.dispatch(1, 1, 1);
    r.holes.bindStorage(9);
    deaths.bindStorage(10);
    if (values.numbers.x > 0) bear.dispatch(groupsOf(values.numbers.x), 1, 1);

    r.dead.bindStorage(9);
    r.holes.bindStorage(10);
    r.tail.bindStorage(11);
    r.living.bindStorage(12);
    markTail.dispatchIndirect(tally, burialGroupsAt);
    r.compaction.compact(r.tail, r.living, {tally, burialsWord}, r.survivors, moved);

    bindColumns();
    r.survivors.bindStorage(9);
    r.holes.bindStorage(10);
    moved.bindStorage(11);
    bury.dispatchIndirect(tally, burialGroupsAt);
}

GpuSystem::GpuSystem(gpu::Device& device, const PartList& parts, std::uint64_t seed) {
    if (const std::string part = partWithoutShader(parts); !part.empty())
        throw InputError("particles on the GPU: " + part + " has no shader");
    state_ = std::make_unique<State>(device, parts, seed);
}

GpuSystem::~GpuSystem() = default;

void GpuSystem::update(const Surroundings& surroundings) {
    if (!(surroundings.stepSeconds > 0)) throw std::invalid_argument("GpuSystem: a step must be longer than 0 s");
    if (surroundings.particlesPerPuff != 1) throw std::invalid_argument("GpuSystem: only one particle for each puff");
    State& s = *state_;
    s.isRead = false;
    const double meanLife = *s.parts.lifetime().meanLifetimeSeconds();
    const Step step{surroundings.scene,
                    surroundings.state,
                    surroundings.stepSeconds,
                    s.seed,
                    static_cast<double>(surroundings.fixedCount) / meanLife,
                    s.tracker.follow(surroundings.scene, surroundings.state, surroundings.stepSeconds),
                    1};
    if (const auto colour = s.parts.colour()->colourOfAll(step)) s.colourOfAll = *colour;
    const auto emitters = s.parts.position()->emitters(step);
    const Births births = emitters.empty() ? Births{} : s.parts.emission()->births(step);
    s.births.add(static_cast<std::uint64_t>(births.count), surroundings.stepSeconds);
    // A fixed number of particles lives as long as their mean life, some up to the longest.
    s.makeRoom(std::max(s.births.bound(), static_cast<std::uint64_t>(static_cast<double>(surroundings.fixedCount) *
                                                                     longestLifeSeconds(s.parts) / meanLife)));
    s.giveHeights(surroundings.scene.terrain);
    s.run(stepValues(s.parts, step, births, emitters, s.nextSerial));
    s.nextSerial += static_cast<std::uint64_t>(births.count);
}

GpuPuffs GpuSystem::buffers() const {
    const State& s = *state_;
    const Room& r = *s.room;
    return {.position = &r.position,
            .velocity = &r.velocity,
            .life = &r.life,
            .look = &r.look,
            .serial = &r.serial,
            .colour = s.coloured ? &r.colour : nullptr,
            .tally = &s.tally,
            .bound = static_cast<std::uint32_t>(s.births.bound()),
            .colourOfAll = s.colourOfAll};
}

std::uint32_t GpuSystem::count() const {
    std::uint32_t count = 0;
    state_->tally.read(std::span(&count, 1));
    return count;
}

const ParticleStore& GpuSystem::readBack() {
    State& s = *state_;
    if (s.isRead) return s.store;
    const std::uint32_t count = this->count();
    ParticleStore& store = s.store;
    store.keepOneColour(!s.coloured);
    store.colourOfAll = s.colourOfAll;
    store.resize(count);
    std::vector<float> words;
    const auto split = [&words, count](const gpu::Buffer& column, std::initializer_list<LedgerVector<float>*> into) {
        const std::size_t stride = into.size();
        words.resize(count * stride);
        column.read(std::span(words));
        std::size_t component = 0;
        for (LedgerVector<float>* values : into) {
            for (std::size_t i = 0; i < count; ++i) (*values)[i] = words[i * stride + component];
            ++component;
        }
    };
    split(s.room->position, {&store.x, &store.y, &store.z});
    split(s.room->velocity, {&store.velocityX, &store.velocityY, &store.velocityZ});
    split(s.room->life, {&store.age, &store.lifetime});
    split(s.room->look, {&store.radius, &store.opacity});
    if (s.coloured) split(s.room->colour, {&store.red, &store.green, &store.blue});
    s.room->serial.read(std::span(store.serial.data(), count));
    s.isRead = true;
    return store;
}

MemoryReport GpuSystem::memory() const {
    MemoryReport report;
    for (const auto& [structure, bytes] : state_->ledger.entries()) report.push_back({structure, bytes, 0});
    for (const auto& [structure, bytes] : state_->gpuLedger.entries()) report.push_back({structure, 0, bytes});
    return report;
}

}  // namespace dustbench::particles
