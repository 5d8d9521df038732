// Springs between the neighbours of a lattice: F = −k·(d − L)·n − c·(n·Δv)·n along each link.
//
// explicit: the forces at the start of the step, with the semi-implicit Euler step of all forces. It is stable while
// k·Δt² + 2·c·Δt < 4·m/λ, where λ bounds the eigenvalues of the links (lattice.h); without damping Δt < 2/ω, with
// ω² = k·λ/m. A longer step is an error.
//
// position: compliant constraints, solved after all other forces, in n substeps with one sweep over all links each:
//
//     v ← v + h·a,  x ← x + h·v,  h = Δt/n                          a: of all other forces, constant in the step
//     Δλ = −(C + γ·∇C·(x − x₀)) / ((1 + γ)·Σ w|∇C|² + α̃)            C = |x_a − x_b| − L,  α̃ = 1/(k·h²),  γ = c/(k·h)
//     x ← x + w·∇C·Δλ,  v ← (x − x₀)/h
//
// One sweep makes λ start at 0 in each substep. For a single spring this is the implicit Euler step, so that it is
// stable at any stiffness and takes energy from an oscillation: E ← E/(1 + ω²h²). A row of N points that hangs from its
// first one is longer by at most 2·N·g·h² in each link than its springs allow, since a sweep passes a load on only in
// part.
//
// Units: SI. Source: MacklinEtAl2016, Eq. 18 and 26; MacklinEtAl2019 (substeps instead of iterations).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/moving_solids.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles::parts::force::springs {
namespace {

struct SpringNumbers {
    double stiffness = 1000;  ///< N/m, of an edge
    double damping = 0;       ///< N·s/m, of an edge, along it
    double massKg = 1;        ///< of a particle
    int substeps = 1;
};

struct Linked {
    const Lattice& lattice;
    const LatticeLinks& links;
    const CarriedFrame& frame;  ///< of the lattice, which pinned particles follow
};

/// Extended position-based dynamics: n substeps, each with one sweep over all links. Links of a colour are shared by
/// threads; results are the same for any number.
class PositionStep {
 public:
    struct Way {
        const StepStart& start;
        const MetSurfaces& surfaces;
        double stepSeconds;
    };
    /// Moves all particles of `store`. Every substep ends at the first surface. A particle that dies there takes part
    /// until the end of the step.
    void run(const SpringNumbers& numbers, const Linked& linked, const Way& way, ParticleStore& store,
             const Fates& fates);

    [[nodiscard]] std::size_t bytes() const { return points_.capacity() * sizeof(Point); }

 private:
    struct Point {
        glm::dvec3 x, before, velocity, acceleration;
        double inverseMass;
    };

    void begin(const SpringNumbers& numbers, const LatticeLinks& links, const StepStart& start, double stepSeconds,
               const ParticleStore& store);

    void meet(const MetSurfaces& surfaces, double h, float leftSeconds, ParticleStore& store, const Fates& fates);

    std::vector<Point> points_;
};

constexpr std::size_t pointBlock = 2048;

template <typename Work>
void forEachPoint(std::size_t points, const Work& work) {
    parallel::forEachBlock(points, pointBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) work(i);
    });
}

/// The acceleration of all other forces: a = (v₁ − v₀)/Δt.
void PositionStep::begin(const SpringNumbers& numbers, const LatticeLinks& links, const StepStart& start,
                         double stepSeconds, const ParticleStore& store) {
    points_.resize(store.size());
    forEachPoint(store.size(), [&](std::size_t i) {
        const glm::dvec3 before(start.velocityX[i], start.velocityY[i], start.velocityZ[i]);
        const glm::dvec3 after(store.velocityX[i], store.velocityY[i], store.velocityZ[i]);
        const glm::dvec3 x(start.x[i], start.y[i], start.z[i]);
        points_[i] = {x, x, before, (after - before) / stepSeconds, 1 / numbers.massKg};
    });
    for (const std::uint32_t i : links.pinned()) points_[i].inverseMass = 0;
}

/// Contacts on the paths of a substep. Only particles with a contact get its position and velocity: others keep theirs,
/// which are not rounded.
void PositionStep::meet(const MetSurfaces& surfaces, double h, float leftSeconds, ParticleStore& store,
                        const Fates& fates) {
    parallel::forEachBlock(points_.size(), chunkSize, [&](std::size_t first, std::size_t count) {
        WayBegins begins;
        for (auto* column : {&begins.x, &begins.y, &begins.z}) column->fill(0);  // or GCC 14 warns
        begins.seconds.fill(static_cast<float>(h));
        std::array<std::array<float, chunkSize>, 6> moved;
        Chunk chunk;
        chunk.count = count;
        chunk.age = &store.age[first];
        chunk.lifetime = &store.lifetime[first];
        chunk.serial = &store.serial[first];
        chunk.dead = &fates.dead[first];
        if (!fates.hits.empty()) chunk.hits = &fates.hits[first / chunkSize];
        std::size_t next = 0;
        for (float** column : {&chunk.x, &chunk.y, &chunk.z, &chunk.velocityX, &chunk.velocityY, &chunk.velocityZ})
            *column = moved[next++].data();
        for (std::size_t i = 0; i < count; ++i) {
            const Point& p = points_[first + i];
            const glm::vec3 from(p.before), to(p.x), v(p.velocity);
            begins.x[i] = from.x, begins.y[i] = from.y, begins.z[i] = from.z;
            chunk.x[i] = to.x, chunk.y[i] = to.y, chunk.z[i] = to.z;
            chunk.velocityX[i] = v.x, chunk.velocityY[i] = v.y, chunk.velocityZ[i] = v.z;
        }
        meetSurfaces(chunk, begins, surfaces, leftSeconds);
        for (std::size_t i = 0; i < count; ++i) {
            Point& p = points_[first + i];
            const glm::vec3 to(chunk.x[i], chunk.y[i], chunk.z[i]);
            if (p.inverseMass == 0 || to == glm::vec3(p.x)) continue;
            p.x = to;
            p.velocity = glm::vec3(chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]);
        }
    });
}

void PositionStep::run(const SpringNumbers& numbers, const Linked& linked, const Way& way, ParticleStore& store,
                       const Fates& fates) {
    const LatticeLinks& links = linked.links;
    const MetSurfaces perSubstep = way.surfaces.perPartOf(numbers.substeps);
    begin(numbers, links, way.start, way.stepSeconds, store);
    const double h = way.stepSeconds / numbers.substeps;
    const double gamma = numbers.damping / (numbers.stiffness * h);
    const auto solve = [&](const Link& link) {
        Point &a = points_[link.a], &b = points_[link.b];
        const double inverseMass = a.inverseMass + b.inverseMass;
        const glm::dvec3 across = a.x - b.x;
        const double length = glm::length(across);
        if (inverseMass == 0 || length == 0) return;
        const glm::dvec3 gradient = across / length;
        const double stretch = length - static_cast<double>(link.restMetres);
        const double moved = glm::dot(gradient, (a.x - a.before) - (b.x - b.before));
        const double compliance = 1 / (numbers.stiffness * static_cast<double>(link.share) * h * h);
        const double lambda = -(stretch + gamma * moved) / ((1 + gamma) * inverseMass + compliance);
        a.x += a.inverseMass * lambda * gradient;
        b.x -= b.inverseMass * lambda * gradient;
    };
    for (int substep = 1; substep <= numbers.substeps; ++substep) {
        forEachPoint(points_.size(), [&](std::size_t i) {
            Point& p = points_[i];
            p.before = p.x;
            p.velocity += h * p.acceleration;
            if (p.inverseMass > 0) p.x += h * p.velocity;
        });
        const auto left = static_cast<float>((numbers.substeps - substep) * h);
        for (const std::uint32_t i : links.pinned())
            points_[i].x = linked.frame.toWorld(glm::vec3(linked.lattice.restOf(store.serial[i])), left);
        links.forEach(solve);
        forEachPoint(points_.size(),
                     [&](std::size_t i) { points_[i].velocity = (points_[i].x - points_[i].before) / h; });
        if (!perSubstep.empty()) meet(perSubstep, h, left, store, fates);
    }
    forEachPoint(points_.size(), [&](std::size_t i) {
        const glm::vec3 x(points_[i].x), v(points_[i].velocity);
        store.x[i] = x.x, store.y[i] = x.y, store.z[i] = x.z;
        store.velocityX[i] = v.x, store.velocityY[i] = v.y, store.velocityZ[i] = v.z;
    });
}

enum class Stepping { byForce, byPosition };
constexpr Choices<Stepping> steppings{{"explicit", Stepping::byForce}, {"position", Stepping::byPosition}};
enum class Beyond { error, run };
constexpr Choices<Beyond> beyondWords{{"error", Beyond::error}, {"run", Beyond::run}};

/// The longest stable explicit step: the positive root of k·Δt² + 2·c·Δt = 4·m/λ.
double limitSeconds(const SpringNumbers& s, double eigenvalue) {
    return (std::sqrt(s.damping * s.damping + 4 * s.massKg * s.stiffness / eigenvalue) - s.damping) / s.stiffness;
}

class Springs final : public ForcePart {
 public:
    explicit Springs(const ParameterValues& values);

    [[nodiscard]] bool needsLattice() const override { return true; }
    /// Throws InputError if the explicit step is too long.
    void begin(const Step& step, const ParticleStore& store) override;
    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] bool settles() const override { return stepping_ == Stepping::byPosition; }
    void settle(ParticleStore& store, const StepStart& start, const Fates& fates, const MetSurfaces& surfaces,
                const Step& step) override;
    void touch(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::size_t bytes() const override;

 private:
    void requireStable(double stepSeconds) const;
    void sumForces(const ParticleStore& store);

    Stepping stepping_;
    Beyond beyond_;
    SpringNumbers numbers_;
    LinkShares shares_;
    Pins pins_;
    CarriedFrame frame_;
    LatticeLinks links_;
    PositionStep positions_;
    std::vector<glm::vec3> accelerations_;  ///< of this step, in the store's order
};

Springs::Springs(const ParameterValues& values)
    : ForcePart(values),
      stepping_(values.choice("step", steppings)),
      beyond_(values.choice("beyond_limit", beyondWords)),
      numbers_{values.real("stiffness"), values.real("damping"), values.real("mass_kg"),
               static_cast<int>(values.integer("substeps"))},
      shares_{static_cast<float>(values.real("diagonals")), static_cast<float>(values.real("bending"))},
      pins_(values.choice("pins", pinWords)) {}

void Springs::requireStable(double stepSeconds) const {
    if (beyond_ == Beyond::run || links_.eigenvalueBound() == 0) return;
    const double limit = limitSeconds(numbers_, links_.eigenvalueBound());
    if (stepSeconds < limit) return;
    throw InputError(
        fmt::format("force springs: got a step of {:.4g} s at stiffness = {:.4g} N/m, allowed: less than "
                    "{:.4g} s, or step = \"position\"",
                    stepSeconds, numbers_.stiffness, limit));
}

void Springs::sumForces(const ParticleStore& s) {
    accelerations_.assign(s.size(), glm::vec3(0));
    const auto k = static_cast<float>(numbers_.stiffness / numbers_.massKg);
    const auto c = static_cast<float>(numbers_.damping / numbers_.massKg);
    links_.forEach([&](const Link& link) {
        const std::uint32_t a = link.a, b = link.b;
        const glm::vec3 across(s.x[b] - s.x[a], s.y[b] - s.y[a], s.z[b] - s.z[a]);
        const glm::vec3 approach(s.velocityX[b] - s.velocityX[a], s.velocityY[b] - s.velocityY[a],
                                 s.velocityZ[b] - s.velocityZ[a]);
        const float length = glm::length(across);
        if (length == 0) return;
        const glm::vec3 n = across / length;
        const glm::vec3 pull = link.share * (k * (length - link.restMetres) + c * glm::dot(n, approach)) * n;
        accelerations_[a] += pull;
        accelerations_[b] -= pull;
    });
}

void Springs::begin(const Step& step, const ParticleStore& store) {
    const Lattice& lattice = *step.lattice;
    const glm::dvec3 velocity =
        lattice.onVehicle ? step.state.vehicle.forward() * step.state.vehicle.speed : glm::dvec3(0);
    frame_.moveTo(lattice.toWorld(step.state), velocity, step.seconds);
    links_.follow(lattice, pins_, shares_, store.serial);
    if (settles()) return;
    requireStable(step.seconds);
    sumForces(store);
}

void Springs::push(Chunk& chunk, const Step&) const {
    if (settles()) return;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3& a = accelerations_[chunk.first + i];
        chunk.accelerationX[i] += a.x;
        chunk.accelerationY[i] += a.y;
        chunk.accelerationZ[i] += a.z;
    }
}

void Springs::settle(ParticleStore& store, const StepStart& start, const Fates& fates, const MetSurfaces& surfaces,
                     const Step& step) {
    positions_.run(numbers_, {*step.lattice, links_, frame_}, {start, surfaces, step.seconds}, store, fates);
}

/// Pinned particles are where the lattice is.
void Springs::touch(Chunk& chunk, const Step& step) const {
    if (pins_ == Pins::none) return;
    const Lattice& lattice = *step.lattice;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        if (!isPinned(pins_, lattice, lattice.nodeOf(chunk.serial[i]))) continue;
        const glm::vec3 rest(lattice.restOf(chunk.serial[i]));
        const glm::vec3 place = frame_.toWorld(rest, 0), velocity = frame_.velocityOf(rest);
        chunk.x[i] = place.x, chunk.y[i] = place.y, chunk.z[i] = place.z;
        chunk.velocityX[i] = velocity.x, chunk.velocityY[i] = velocity.y, chunk.velocityZ[i] = velocity.z;
    }
}

std::size_t Springs::bytes() const {
    return links_.bytes() + positions_.bytes() + accelerations_.capacity() * sizeof(glm::vec3);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "springs between the neighbours of a lattice (position `lattice`): chains, cloth, soft bodies";
    info.source = "Provot1995, 2; MacklinEtAl2016; Thesis, 5.4.1 and 7.3";
    info.parameters
        .choice("step", Stepping::byPosition, steppings,
                "explicit: forces, with a limit on the step; position: compliant constraints, stable at any stiffness")
        .real("stiffness", 1000, 1e-3, 1e9, "N/m", "k of each edge")
        .real("damping", 0, 0, 1e6, "N·s/m", "c of each edge, against changes of its length")
        .real("mass_kg", 1, 1e-6, 1e6, "kg", "m of each particle, for springs only: other forces are accelerations")
        .real("diagonals", 0.5, 0, 1, "", "stiffness of diagonals as a share of that of edges; 0: none")
        .real("bending", 0.1, 0, 1, "", "stiffness of links across one point, which resist bending; 0: none")
        .choice("pins", Pins::none, pinWords, pinHelp)
        .integer("substeps", 10, 1, 1000, "", "substeps of each step with step=position")
        .choice("beyond_limit", Beyond::error, beyondWords,
                "explicit steps beyond the stability limit: report an error, or run them anyway");
    info.create = [](const ParameterValues& values) { return std::make_unique<Springs>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::springs
