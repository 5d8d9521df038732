// One panel with its relief, and the particles that enter it, move in it, hit it and wear it.
//
// Units: m, m/s. Owns: surface, particles and their picture. Threads: the OpenGL thread; steps use the current oneTBB
// arena. Source: Bergeron, 3 (create, move, collide, age the surface, draw it).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/relief/ageing.h"
#include "methods/relief/drawing/relief_pass.h"
#include "methods/relief/particles/panel_frame.h"
#include "methods/relief/particles/relief_particles.h"
#include "methods/relief/particles_gl/texture_mover.h"
#include "methods/relief/surface/depth_map.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

/// How a surface applies hits: each texel visits all hits, or each hit writes its texels.
enum class Search { gather, scatter };
inline constexpr Choices<Search> searches{{"gather", Search::gather}, {"scatter", Search::scatter}};

/// Storage of the particles' state, and the processor that moves them: columns and the CPU, or textures and a shader as
/// in the paper.
enum class StateIn { array, texture };
inline constexpr Choices<StateIn> statesIn{{"array", StateIn::array}, {"texture", StateIn::texture}};

struct ReliefSettings {
    StateIn state = StateIn::array;
    MotionLaw motion = MotionLaw::fixed;
    float gravity = 9.8f;  ///< m/s²
    float maximumAgeSteps = 600;
    AgeingSettings ageing;
    Search search = Search::scatter;
    ReliefStyle style;
};

class LivingRelief {
 public:
    /// `scene` and the panel in it must outlive this object.
    LivingRelief(const scene::Scene& scene, const scene::Panel& panel, const ReliefSettings& settings,
                 gpu::Device& device, MemoryLedger& ledger);

    /// Adds the dust that passed the face in this step and is not in `taken`, and inserts its serials there.
    void create(const Frame& frame, SerialSet& taken);
    void move(double stepSeconds);
    void age();
    void upload();

    /// `shadow`: the car's shadow; null in a scene without a car. `dust`: the dust's, if the scene's lights are on it.
    void draw(const scene::View& view, const CarShadow* shadow, const draw::DustShadow* dust) {
        picture_.draw(view, toWorld_, takesCarShadow_ ? shadow : nullptr, dust);
    }

    /// The current surface with its colour, `depth_removed` and `deposit` (m), and `hits`; with StateIn::texture also
    /// the textures `NAME position` (panel frame, m; age in steps) and `NAME velocity` (m/s; Fate).
    void handOver(VolumeVisitor& visitor) const;

    [[nodiscard]] const WornSurface& surface() const { return surface_; }
    [[nodiscard]] const ReliefParticles& particles() const { return particles_; }
    /// Place and velocity of a particle within the relief, in the world.
    [[nodiscard]] Moving inWorld(std::size_t particle) const;
    [[nodiscard]] glm::dvec3 placeInWorld(const glm::dvec3& relief) const;
    [[nodiscard]] std::uint64_t hits() const { return hits_; }
    [[nodiscard]] std::size_t gpuBytes() const { return picture_.gpuBytes() + (textures_ ? textures_->gpuBytes() : 0); }
    void addTo(maths::Hash& hash) const;

 private:
    [[nodiscard]] std::optional<glm::dvec3> entryOf(const glm::dvec3& from, const glm::dvec3& to) const;
    void enter(const Puffs& dust, std::size_t i, double stepSeconds, SerialSet& taken);

    const scene::Panel& panel_;
    ReliefSettings settings_;
    bool takesCarShadow_;  ///< a panel on the car itself does not
    WornSurface surface_;
    DepthPyramid pyramid_;
    ReliefParticles particles_;
    std::unique_ptr<TextureMover> textures_;  ///< of StateIn::texture
    ReliefPass picture_;
    glm::dmat4 toWorld_{1};
    std::optional<glm::dmat4> toWorldBefore_;
    PanelFrame frame_;
    std::vector<Impact> impacts_;
    std::uint64_t hits_ = 0;
};

}  // namespace dustbench::relief
