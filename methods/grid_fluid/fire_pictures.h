// Pictures of a fire and of single pieces, with parallel rays, as volumes and as particles.
//
// Units: metres; linear RGB. Frame: a box from the origin on, `widthMetres` × 2 `widthMetres` × `widthMetres`.
// Threads: the current oneTBB arena; results do not depend on their number.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "methods/kit/raycast/transfer_function.h"

namespace dustbench::grid_fluid::fire {

inline constexpr double widthMetres = 1.6;
inline constexpr double extinctionPerMetre = 6;  ///< at a density of 1

/// A particle of a fire, or a single piece: a puff with its freshness.
struct Flake {
    glm::dvec3 centre;
    double deviation;  ///< s
    double depth;      ///< τ of smoke
    double reaction;   ///< 1 fresh … 0 burnt out
};

struct FireGrid {
    int cells = 0;  ///< across; twice as many upwards
    std::vector<float> density, reaction;
    [[nodiscard]] double spacingMetres() const { return widthMetres / cells; }
};

/// Density and reaction at any place.
using FireField = std::function<glm::dvec2(const glm::dvec3&)>;

/// One ray per pixel along −z, rows from the bottom.
struct Picture {
    int width = 0, height = 0;
    std::vector<glm::dvec3> colours;  ///< premultiplied
    std::vector<double> alphas;
};

[[nodiscard]] Picture pictureOf(const FireGrid& grid, const raycast::TransferFunction& flame, int width);
/// Puffs as billboards, from the farthest to the nearest.
[[nodiscard]] Picture pictureOf(std::vector<Flake> flakes, const raycast::TransferFunction& flame, int width);

/// Mean freshness of the fire along the rays, premultiplied in each channel. Independent of the march whose pictures it
/// evaluates.
[[nodiscard]] Picture freshnessOf(const FireGrid& grid, int width);

struct FieldPictures {
    Picture shown, freshness;
};
/// Marches directly through a field, without cells or particles, in steps of `stepMetres`.
[[nodiscard]] FieldPictures picturesOf(const FireField& field, double stepMetres,
                                       const raycast::TransferFunction& flame, int width);

/// ‖a − b‖ / ‖b‖ of the colours over black.
[[nodiscard]] double distanceOf(const Picture& picture, const Picture& reference);

/// Spearman's rank correlation of freshness and visible luminance, over the pixels that both pictures cover.
[[nodiscard]] double correlationOf(const Picture& picture, const Picture& freshness);

/// Share of the pieces that have their own maximum of the picture's alpha within one deviation of their centre.
[[nodiscard]] double piecesSeen(const Picture& picture, const std::vector<Flake>& pieces);

}  // namespace dustbench::grid_fluid::fire
