#include "methods/exact_tiles/puff_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::exact_tiles {
namespace {

/// Margin of cosines, which are single precision.
constexpr float cosineMargin = 1e-5f;

/// The camera's axes and image plane in double precision.
struct Eye {
    explicit Eye(const scene::View& view) : position(view.camera.eye), width(view.width), height(view.height) {
        const glm::dvec3 sight = view.camera.target - view.camera.eye;
        if (glm::length(sight) > 0) ahead = glm::normalize(sight);
        // As in scene::View: `up` is not usable if the camera looks along it.
        glm::dvec3 side = glm::cross(ahead, view.camera.up);
        if (glm::length(side) < 1e-9) side = glm::cross(ahead, glm::dvec3(0, 0, -1));
        if (glm::length(side) < 1e-9) side = glm::cross(ahead, glm::dvec3(1, 0, 0));
        right = glm::normalize(side);
        up = glm::cross(right, ahead);
        pixelSlope = 2 * std::tan(view.camera.verticalFieldOfView / 2) / view.height;
        if (!std::isfinite(glm::length(position) + glm::length(ahead) + glm::length(up) + pixelSlope))
            throw std::invalid_argument("exact tiles: the camera's eye, target, up or field of view is not finite");
    }

    [[nodiscard]] glm::dvec3 fromWorld(const glm::dvec3& world) const {
        const glm::dvec3 v = world - position;
        return {glm::dot(v, right), glm::dot(v, up), glm::dot(v, ahead)};
    }
    [[nodiscard]] double pixelX(double slope) const { return slope / pixelSlope + 0.5 * width; }
    [[nodiscard]] double pixelY(double slope) const { return slope / pixelSlope + 0.5 * height; }
    /// Unit vector of the ray through an image position in pixels.
    [[nodiscard]] glm::dvec3 ray(double x, double y) const {
        return glm::normalize(glm::dvec3((x - 0.5 * width) * pixelSlope, (y - 0.5 * height) * pixelSlope, 1));
    }

    glm::dvec3 position, right{1, 0, 0}, up{0, 1, 0}, ahead{0, 0, -1};
    int width, height;
    double pixelSlope;  ///< change of a ray's slope from pixel to pixel, along both axes
};

/// Range of slopes at which the half-plane through the camera's other axis meets the sphere of radius R.
struct Slopes {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};
Slopes slopesOf(double slopesX, double ahead, double reach) {
    if (!(ahead > reach)) return {};
    const double root = reach * std::sqrt(slopesX * slopesX + ahead * ahead - reach * reach);
    const double scale = 1 / ((ahead - reach) * (ahead + reach));
    return {(slopesX * ahead - root) * scale, (slopesX * ahead + root) * scale};
}

/// Tiles between two image positions in pixels.
std::pair<std::int16_t, std::int16_t> tilesBetween(double low, double high, int tiles) {
    const double first = std::clamp(std::floor((low - 0.5) / tilePixels), 0.0, static_cast<double>(tiles));
    const double end = std::clamp(std::floor((high + 0.5) / tilePixels) + 1, 0.0, static_cast<double>(tiles));
    return {static_cast<std::int16_t>(first), static_cast<std::int16_t>(end)};
}

}  // namespace

PuffTiles::PuffTiles(MemoryLedger& ledger)
    : seen_(ledger.account("puffs in view")),
      order_(ledger.account("puffs in view")),
      footprints_(ledger.account("puffs in view")),
      packed_(ledger.account("puffs in view")),
      lists_(ledger.account("lists of tiles")),
      entries_(ledger.account("lists of tiles")) {}

void PuffTiles::build(const Puffs& dust, const scene::View& view, double toleratedDepth, Along order) {
    columns_ = (view.width + tilePixels - 1) / tilePixels;
    rows_ = (view.height + tilePixels - 1) / tilePixels;
    project(dust, view, toleratedDepth, order);
    list(view);
}

void PuffTiles::project(const Puffs& dust, const scene::View& view, double toleratedDepth, Along order) {
    const Eye eye(view);
    const double neglected = toleratedDepth / static_cast<double>(std::max<std::size_t>(dust.size(), 1));
    // A tile's rays are within this angle of its central ray; angles change fastest at the centre of the image.
    const double tileAngle = std::atan(tilePixels * std::numbers::sqrt2 / 2 * eye.pixelSlope);
    seen_.clear();
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const double s = maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        const double tau = maths::puffOpticalDepth(static_cast<double>(dust.opacity[i]));
        if (!(s > 0) || !(tau > neglected)) continue;
        const double reach = s * std::sqrt(2 * std::log(tau / neglected));
        const double extent = sigmasAlongRay * s;
        const glm::dvec3 c = eye.fromWorld(glm::dvec3(dust.position(i)));
        if (c.z < -reach) continue;
        const Slopes slopesX = slopesOf(c.x, c.z, reach), slopesY = slopesOf(c.y, c.z, reach);
        const auto [firstColumn, endColumn] = tilesBetween(eye.pixelX(slopesX.low), eye.pixelX(slopesX.high), columns_);
        const auto [firstRow, endRow] = tilesBetween(eye.pixelY(slopesY.low), eye.pixelY(slopesY.high), rows_);
        if (firstColumn >= endColumn || firstRow >= endRow) continue;

        const double distance = glm::length(c);
        const bool ahead = c.z > 2 * std::max(reach, extent);
        const double falloff = std::numbers::log2e / (2 * s * s);
        const double front = ahead ? std::sqrt(distance * distance - reach * reach) - extent : 0;
        const glm::vec3 colour = dust.colour(i);
        Unordered one{};
        PackedPuff& puff = one.puff;
        if (ahead) {
            const double x = eye.pixelX(c.x / c.z), y = eye.pixelY(c.y / c.z);
            puff.pixelX = static_cast<float>(std::floor(x));
            puff.pixelY = static_cast<float>(std::floor(y));
            puff.fractionX = static_cast<float>(x - std::floor(x));
            puff.fractionY = static_cast<float>(y - std::floor(y));
            puff.slopeX = static_cast<float>(c.x / c.z);
            puff.slopeY = static_cast<float>(c.y / c.z);
            puff.axisMetres = static_cast<float>(c.z);
            puff.falloff = static_cast<float>(falloff * c.z * c.z * eye.pixelSlope * eye.pixelSlope);
        } else {
            puff.pixelX = static_cast<float>(c.x);
            puff.pixelY = static_cast<float>(c.y);
            puff.fractionX = static_cast<float>(c.z);
            puff.falloff = static_cast<float>(falloff);
        }
        puff.logDepth = static_cast<float>(std::log2(tau));
        puff.inverseWidth = static_cast<float>(1 / (std::numbers::sqrt2 * s));
        puff.front = static_cast<float>(std::max(front, 0.0));
        puff.back = static_cast<float>(distance + extent);
        puff.red = colour.r, puff.green = colour.g, puff.blue = colour.b;

        one.footprint = {firstColumn, endColumn, firstRow, endRow, 0, 0, 1, -2};
        if (distance > reach) {
            const double angle = std::asin(reach / distance) + tileAngle;
            one.footprint.x = static_cast<float>(c.x / distance);
            one.footprint.y = static_cast<float>(c.y / distance);
            one.footprint.z = static_cast<float>(c.z / distance);
            if (angle < std::numbers::pi)
                one.footprint.leastCosine = static_cast<float>(std::cos(angle)) - cosineMargin;
        }
        one.key = ahead ? (order == Along::back ? puff.back : puff.front) : -1.0f;
        seen_.push_back(one);
    }

    order_.resize(seen_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, [&](std::uint32_t a, std::uint32_t b) {
        return seen_[a].key != seen_[b].key ? seen_[a].key < seen_[b].key : a < b;
    });
    packed_.clear();
    footprints_.clear();
    aroundEye_ = 0;
    for (const std::uint32_t i : order_) {
        packed_.push_back(seen_[i].puff);
        footprints_.push_back(seen_[i].footprint);
        aroundEye_ += seen_[i].key < 0 ? 1 : 0;
    }
}

void PuffTiles::list(const scene::View& view) {
    const Eye eye(view);
    const auto tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    lists_.assign(tiles + 1, TileList{0, 0});

    // Calls visit(tile, puff) for a row's tiles in the order of the puffs.
    const auto visitRow = [&](int row, const auto& visit) {
        std::vector<glm::vec3> middles;
        middles.reserve(static_cast<std::size_t>(columns_));
        for (int column = 0; column < columns_; ++column)
            middles.emplace_back(eye.ray((column + 0.5) * tilePixels, (row + 0.5) * tilePixels));
        for (std::size_t i = 0; i < footprints_.size(); ++i) {
            const Footprint& footprint = footprints_[i];
            if (row < footprint.firstRow || row >= footprint.endRow) continue;
            for (int column = footprint.firstColumn; column < footprint.endColumn; ++column) {
                const glm::vec3& middle = middles[static_cast<std::size_t>(column)];
                const float cosine = footprint.x * middle.x + footprint.y * middle.y + footprint.z * middle.z;
                if (cosine < footprint.leastCosine) continue;
                visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column),
                      i);
            }
        }
    };

    parallel::forEachBlock(static_cast<std::size_t>(rows_), 1, [&](std::size_t row, std::size_t) {
        visitRow(static_cast<int>(row), [&](std::size_t tile, std::size_t i) {
            ++lists_[tile].begin;
            if (i < aroundEye_) ++lists_[tile].ahead;
        });
    });
    std::uint32_t total = 0;
    for (TileList& list : lists_) {
        const std::uint32_t count = list.begin, around = list.ahead;
        list = {total, total + around};
        total += count;
    }
    entries_.resize(total);
    parallel::forEachBlock(static_cast<std::size_t>(rows_), 1, [&](std::size_t row, std::size_t) {
        std::vector<std::uint32_t> next;
        const std::size_t first = row * static_cast<std::size_t>(columns_);
        for (std::size_t column = 0; column < static_cast<std::size_t>(columns_); ++column)
            next.push_back(lists_[first + column].begin);
        visitRow(static_cast<int>(row), [&](std::size_t tile, std::size_t i) {
            entries_[next[tile - first]++] = static_cast<std::uint32_t>(i);
        });
    });
}

}  // namespace dustbench::exact_tiles
