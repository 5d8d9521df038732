// The kind of part that describes the appearance of particles. Methods do the drawing.
//
// Source: Thesis, 3.1.3 and 4.1. Departs: many methods can draw one system, so the part contains no drawing code.
#pragma once

#include <string>

#include "methods/contract/choices.h"
#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {

/// The shapes that a file can request.
enum class Primitive { puff, points, lines, curves, hybrid, sprites, movingSprites, objects, surface };

/// Meshes hide each other by depth; other primitives are blended.
[[nodiscard]] constexpr bool isMesh(Primitive primitive) {
    return primitive == Primitive::objects || primitive == Primitive::surface;
}

enum class Blending {
    alpha,     ///< C = α·C_particle + (1 − α)·C, sorted far to near
    additive,  ///< C = α·C_particle + C, in any order
};
inline constexpr Choices<Blending> blendings{{"alpha", Blending::alpha}, {"additive", Blending::additive}};

enum class AntiAliasing {
    copies,        ///< of each sprite, between its old position and its new one
    accumulation,  ///< the mean of pictures at times within the step
};
inline constexpr Choices<AntiAliasing> antiAliasings{{"copies", AntiAliasing::copies},
                                                     {"accumulation", AntiAliasing::accumulation}};

/// All properties of the appearance that a file can set; a part sets those of its primitive.
struct Look {
    Primitive primitive = Primitive::puff;
    Blending blending = Blending::alpha;
    bool clamped = true;        ///< additive light: clamped to 1 in a separate buffer
    float pixels = 0;           ///< width of points; 0: the particle's own size
    bool round = false;         ///< points with a Gaussian profile
    float seconds = 0;          ///< duration of the path of lines and copies; 0: one step
    int steps = 1;              ///< steps of the path of curves
    int pieces = 1;             ///< straight pieces of a curve in each step
    std::string picture{};      ///< for sprites: a name in data/textures or a file; empty: a Gaussian
    float framesPerSecond = 0;  ///< of a strip that is a video; 0: each sprite shows one picture of it
    int copies = 1;             ///< copies of anti-aliased sprites
    AntiAliasing by = AntiAliasing::copies;
    bool fading = false;  ///< newer copies have more weight
    std::string mesh{};   ///< for objects: a name in data/scenes/meshes or a file
    bool alongVelocity = false;
    int squares = 0;       ///< for a surface: points along each square of a chequered one; 0: one colour
    float darkShare = 1;   ///< for a surface: brightness of every second square
    Lattice lattice{};     ///< for a surface: that of the position part, set by the method
    bool stereo = false;   ///< for red-green glasses, the left eye green
    float eyesMetres = 0;  ///< distance of the two eyes
};

class RenderPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::render; }

    [[nodiscard]] virtual Look look() const = 0;

 protected:
    /// `blend`, `clamped`, and the options of all primitives: `stereo`, `eyes_metres`.
    static void declareBlending(ParameterSet& set, Blending initial);
    static void declareStereo(ParameterSet& set);
    /// A look with these parameters.
    [[nodiscard]] Look lookOf(Primitive primitive) const;
};

/// A part without state: its parameters are its look. `Traits` has `primitive` and `complete(Look&, values)`.
template <typename Traits>
class LookPart final : public RenderPart {
 public:
    explicit LookPart(const ParameterValues& values) : RenderPart(values), look_(lookOf(Traits::primitive)) {
        Traits::complete(look_, values);
    }
    [[nodiscard]] Look look() const override { return look_; }
    [[nodiscard]] bool needsLattice() const override { return Traits::primitive == Primitive::surface; }

    [[nodiscard]] static PartInfo describe(std::string help, std::string source, Blending initial) {
        PartInfo info;
        info.help = std::move(help);
        info.source = std::move(source);
        Traits::declare(info.parameters);
        if (!isMesh(Traits::primitive)) declareBlending(info.parameters, initial);
        declareStereo(info.parameters);
        info.create = [](const ParameterValues& values) { return std::make_unique<LookPart>(values); };
        return info;
    }

 private:
    Look look_;
};

}  // namespace dustbench::particles
