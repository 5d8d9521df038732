// Springs between the neighbours of a lattice: F = −k·(d − L)·n − c·(n·Δv)·n along each link.
//
// explicit: the forces at the start of the step, with the semi-implicit Euler step of all forces. It is stable while
// k·Δt² + 2·c·Δt < 4·m/λ, where λ bounds the eigenvalues of the links (lattice_links.h); without damping Δt < 2/ω, with
// ω² = k·λ/m. A longer step is an error.
// position: compliant constraints, solved after all other forces (position_step.h): stable at any stiffness.
#include <fmt/format.h>

#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/particles/carried_frame.h"
#include "methods/kit/particles/force_part.h"
#include "methods/kit/particles/lattice_links.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/position_step.h"

namespace dustbench::particles::parts::force::springs {
namespace {

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
