// Extended position-based dynamics of linked particles: n substeps, each with one sweep over all links.
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
// Units: SI. Owns: its points. Threads: links of a colour are shared by threads; results are the same for any number.
// Source: MacklinEtAl2016, Eq. 18 and 26; MacklinEtAl2019 (substeps instead of iterations).
#pragma once

#include <vector>

#include "methods/kit/particles/carried_frame.h"
#include "methods/kit/particles/force_part.h"
#include "methods/kit/particles/lattice_links.h"

namespace dustbench::particles {

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

}  // namespace dustbench::particles
