#include "methods/grid_fluid/fire_pictures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/raycast/grid_raycast.h"
#include "methods/kit/raycast/plain_march.h"

namespace dustbench::grid_fluid::fire {
namespace {

constexpr double minimumAlpha = 1e-4;  ///< pixels with a smaller alpha count as empty

/// The light reflected by smoke: dark smoke in daylight.
raycast::Reflected smoke() {
    return raycast::cloudColour(glm::vec3(0.1f), scene::Lights{});
}

template <typename Colour>
Picture pictureByRays(int width, const Colour& colourOf) {
    Picture picture{width, 2 * width, {}, {}};
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(picture.height);
    picture.colours.resize(pixels);
    picture.alphas.resize(pixels);
    const double edge = widthMetres / width;
    parallel::forEachBlock(pixels, static_cast<std::size_t>(width), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const std::size_t row = i / static_cast<std::size_t>(width), column = i % static_cast<std::size_t>(width);
            const glm::dvec4 seen =
                colourOf(glm::dvec2(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5) * edge);
            picture.colours[i] = glm::dvec3(seen);
            picture.alphas[i] = seen.a;
        }
    });
    return picture;
}

/// Rank of each value, ties sharing their mean.
std::vector<double> ranksOf(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> ranks(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = first;
        while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
        for (std::size_t k = first; k <= last; ++k) ranks[order[k]] = static_cast<double>(first + last) / 2;
        first = last + 1;
    }
    return ranks;
}

double correlationOf(const std::vector<double>& a, const std::vector<double>& b) {
    const auto meanOf = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    };
    const double meanA = meanOf(a), meanB = meanOf(b);
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - meanA) * (b[i] - meanB);
        aa += (a[i] - meanA) * (a[i] - meanA);
        bb += (b[i] - meanB) * (b[i] - meanB);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// A sum over the cells along a ray.
glm::dvec4 freshnessSeen(const FireGrid& grid, const raycast::TransferFunction& flame, const glm::dvec2& place) {
    const glm::ivec2 last(grid.cells - 1, 2 * grid.cells - 1);
    const glm::dvec2 at = place / grid.spacingMetres() - 0.5, low = glm::floor(at), share = at - low;
    const auto cell = [&](int i, int j, int k) {
        const glm::ivec2 c = glm::clamp(glm::ivec2(low) + glm::ivec2(i, j), glm::ivec2(0), last);
        return static_cast<std::size_t>((k * 2 * grid.cells + c.y) * grid.cells + c.x);
    };
    const auto between = [&](const std::vector<float>& values, int k) {
        const auto row = [&](int j) {
            return glm::mix(static_cast<double>(values[cell(0, j, k)]), static_cast<double>(values[cell(1, j, k)]),
                            share.x);
        };
        return glm::mix(row(0), row(1), share.y);
    };
    double depth = 0, fresh = 0;
    for (int k = grid.cells - 1; k >= 0; --k) {
        const double reaction = between(grid.reaction, k);
        const double next = depth + extinctionPerMetre * static_cast<double>(flame.at(reaction).a) *
                                        between(grid.density, k) * grid.spacingMetres();
        fresh += (std::exp(-depth) - std::exp(-next)) * reaction;
        depth = next;
    }
    return {glm::dvec3(fresh), -std::expm1(-depth)};
}

glm::dvec4 marched(const FireGrid& grid, const raycast::TransferFunction& flame, const raycast::Reflected& reflected,
                   const glm::dvec2& place) {
    raycast::PlainVolume volume;
    volume.grid = {
        {grid.cells, 2 * grid.cells, grid.cells}, grid.spacingMetres(), {0, 0, 0}, grid.density, grid.reaction};
    volume.settings.extinctionPerMetre = extinctionPerMetre;
    volume.settings.stopAlpha = 1;
    volume.settings.fire = flame;
    volume.reflected = reflected;
    const double edge = grid.spacingMetres();
    return raycast::plainMarch(volume, {{place.x / edge, place.y / edge, grid.cells + 1.0}, {0, 0, -1}, 1e9, 0.5});
}

}  // namespace

Picture pictureOf(const FireGrid& grid, const raycast::TransferFunction& flame, int width) {
    const raycast::Reflected reflected = smoke();
    return pictureByRays(width, [&](const glm::dvec2& place) { return marched(grid, flame, reflected, place); });
}

Picture pictureOf(std::vector<Flake> flakes, const raycast::TransferFunction& flame, int width) {
    constexpr double reach = 3;  // deviations, as for billboards
    std::ranges::stable_sort(flakes, {}, [](const Flake& flake) { return flake.centre.z; });
    const glm::dvec3 reflected(smoke().all());
    std::vector<glm::dvec4> looks;  // colour, and depth at the centre
    for (const Flake& flake : flakes) {
        const glm::dvec4 burning(flame.at(flake.reaction));
        looks.emplace_back(glm::dvec3(burning) + reflected, flake.depth * burning.a);
    }
    return pictureByRays(width, [&](const glm::dvec2& place) {
        glm::dvec4 seen(0);
        for (std::size_t i = 0; i < flakes.size(); ++i) {
            const double s = flakes[i].deviation;
            const glm::dvec2 apart = place - glm::dvec2(flakes[i].centre);
            const double square = glm::dot(apart, apart);
            if (square > reach * reach * s * s) continue;
            const double alpha = -std::expm1(-looks[i].a * std::exp(-square / (2 * s * s)));
            seen = alpha * glm::dvec4(glm::dvec3(looks[i]), 1) + (1 - alpha) * seen;
        }
        return seen;
    });
}

double distanceOf(const Picture& picture, const Picture& reference) {
    double apart = 0, whole = 0;
    for (std::size_t i = 0; i < picture.colours.size(); ++i) {
        const glm::dvec3 difference = picture.colours[i] - reference.colours[i];
        apart += glm::dot(difference, difference);
        whole += glm::dot(reference.colours[i], reference.colours[i]);
    }
    return std::sqrt(apart / whole);
}

Picture freshnessOf(const FireGrid& grid, int width) {
    const raycast::TransferFunction flame;
    return pictureByRays(width, [&](const glm::dvec2& place) { return freshnessSeen(grid, flame, place); });
}

FieldPictures picturesOf(const FireField& field, double stepMetres, const raycast::TransferFunction& flame, int width) {
    const glm::dvec3 reflected(smoke().all());
    const auto steps = static_cast<int>(std::lround(widthMetres / stepMetres));
    // Each ray is followed once, for both pictures.
    FieldPictures pictures;
    pictures.freshness = pictureByRays(width, [](const glm::dvec2&) { return glm::dvec4(0); });
    pictures.shown = pictureByRays(width, [&](const glm::dvec2& place) {
        double depth = 0, fresh = 0;
        glm::dvec3 colour(0);
        for (int step = steps - 1; step >= 0; --step) {
            const glm::dvec2 there = field({place, (step + 0.5) * stepMetres});
            const glm::dvec4 look(flame.at(there.y));
            const double next = depth + extinctionPerMetre * look.a * there.x * stepMetres;
            const double share = std::exp(-depth) - std::exp(-next);
            fresh += share * there.y;
            colour += share * (reflected + glm::dvec3(look));
            depth = next;
        }
        const double alpha = -std::expm1(-depth);
        const glm::dvec2 pixel = place / (widthMetres / width);
        const auto at =
            static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(pixel.x);
        pictures.freshness.colours[at] = glm::dvec3(fresh);
        pictures.freshness.alphas[at] = alpha;
        return glm::dvec4(colour, alpha);
    });
    return pictures;
}

double correlationOf(const Picture& picture, const Picture& freshness) {
    std::vector<double> fresh, seen;
    for (std::size_t i = 0; i < picture.alphas.size(); ++i) {
        if (std::min(picture.alphas[i], freshness.alphas[i]) < 1.0 / 255) continue;
        fresh.push_back(freshness.colours[i].r / freshness.alphas[i]);
        seen.push_back(glm::dot(picture.colours[i], glm::dvec3(0.2126, 0.7152, 0.0722)) / picture.alphas[i]);
    }
    return correlationOf(ranksOf(fresh), ranksOf(seen));
}

double piecesSeen(const Picture& picture, const std::vector<Flake>& pieces) {
    const double edge = widthMetres / picture.width;
    const auto alphaAt = [&](int x, int y) {
        return x < 0 || y < 0 || x >= picture.width || y >= picture.height
                   ? 0.0
                   : picture.alphas[static_cast<std::size_t>(y * picture.width + x)];
    };
    // Of equal neighbours only the first counts.
    const auto isMaximum = [&](int x, int y) {
        const double alpha = alphaAt(x, y);
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const bool before = j < 0 || (j == 0 && i < 0), itself = j == 0 && i == 0;
                const double neighbour = alphaAt(x + i, y + j);
                if (before ? neighbour >= alpha : !itself && neighbour > alpha) return false;
            }
        return alpha > minimumAlpha;
    };
    // A maximum belongs to one piece at most.
    std::vector<bool> taken(picture.alphas.size());
    int seen = 0;
    for (const Flake& piece : pieces) {
        const glm::dvec2 middle = glm::dvec2(piece.centre) / edge;
        const int reach = std::max(1, static_cast<int>(std::lround(piece.deviation / edge)));
        const glm::ivec2 at(middle);
        bool found = false;
        for (int y = at.y - reach; y <= at.y + reach && !found; ++y)
            for (int x = at.x - reach; x <= at.x + reach && !found; ++x) {
                const auto i = static_cast<std::size_t>(y * picture.width + x);
                found = isMaximum(x, y) && !taken[i];
                if (found) taken[i] = true;
            }
        seen += found ? 1 : 0;
    }
    return static_cast<double>(seen) / static_cast<double>(pieces.size());
}

}  // namespace dustbench::grid_fluid::fire
