#include "bench/reference/cloud_march.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/reference/camera_rays.h"
#include "bench/reference/puff_list.h"
#include "bench/reference/sun_lattice.h"
#include "methods/contract/volume.h"
#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::reference {
namespace {

constexpr double maximumSlabs = 4e6;  ///< per ray: limit of memory and time
/// A slab is skipped if its share of the light is smaller; it still attenuates everything behind it.
constexpr double minimumShare = 1e-9;

/// A puff in one row.
struct RowPuff {
    const Puff* puff;
    RowGeometry geometry;
    Columns columns;
    double scale, inverseWidth;  ///< 1/2s², 1/(√2·s)
    glm::dvec3 colour;
};

/// A puff along one ray: τ·exp(−b²/2s²), its foot, and the interval that it covers.
struct RayPuff {
    double depth, foot, inverseWidth, begin, end;
    glm::dvec3 colour;
};

struct Lighting {
    const SunLight& light;
    SunLattice depths;

    /// Sunlight scattered along a ray of this direction.
    [[nodiscard]] glm::dvec3 scattered(const glm::dvec3& direction) const {
        const double cosine = glm::dot(direction, glm::normalize(light.toSun));
        return light.sun / 4.0 *
               static_cast<double>(scene::phaseFactor(static_cast<float>(light.asymmetry), static_cast<float>(cosine)));
    }
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& position, const glm::dvec3& scattered) const {
        return scattered * std::exp(-depths.at(position)) + light.ambient;
    }
};

struct MarchedPixel {
    glm::dvec3 colour{0};
    double depth = 0;
    double unevenness = 0;  ///< Σ T·Δ²/8
};

/// Marches one ray at a time; reuses its buffers.
class RayMarch {
 public:
    explicit RayMarch(double slabMetres) : slabMetres_(slabMetres) {}

    void begin(double sceneMetres) {
        sceneMetres_ = sceneMetres;
        puffs_.clear();
    }

    /// Adds the puff along the ray of column slope x; `inverseSquare` is 1/D.
    void add(const RowPuff& row, double x, double inverseSquare) {
        const double u = x - row.geometry.x0;
        const double squareB = (row.geometry.gamma * u * u + row.geometry.kappa) * inverseSquare;
        const double depth = row.puff->opticalDepth * std::exp(-squareB * row.scale);
        const double foot = (row.geometry.footAtZero + row.geometry.footPerSlope * x) * std::sqrt(inverseSquare);
        const double half = sigmasAlongRay * row.puff->deviationMetres;
        const RayPuff puff{
            depth, foot, row.inverseWidth, std::max(0.0, foot - half), std::min(sceneMetres_, foot + half), row.colour};
        if (puff.begin < puff.end) puffs_.push_back(puff);
    }

    [[nodiscard]] std::size_t size() const { return puffs_.size(); }

    /// `eye` and `direction` of the ray in world coordinates; `lighting` may be null.
    MarchedPixel run(const Lighting* lighting, const glm::dvec3& eye, const glm::dvec3& direction) {
        MarchedPixel pixel;
        if (puffs_.empty()) return pixel;
        fillSlabs();
        const glm::dvec3 scattered = lighting ? lighting->scattered(direction) : glm::dvec3(1);
        double transmittance = 1;
        for (std::size_t k = 0; k < depths_.size(); ++k) {
            const double depth = depths_[k];
            if (!(depth > 0)) continue;
            pixel.depth += depth;
            const double reached = transmittance;
            transmittance *= std::exp(-depth);
            if (reached * depth < minimumShare) continue;
            glm::dvec3 seen = glm::dvec3(reds_[k], greens_[k], blues_[k]) / depth * (reached * -std::expm1(-depth));
            if (lighting)
                seen *= lighting->at(eye + (begin_ + (static_cast<double>(k) + 0.5) * length_) * direction, scattered);
            pixel.colour += seen;
            pixel.unevenness += reached * depth * depth / 8;
        }
        return pixel;
    }

 private:
    void fillSlabs() {
        begin_ = puffs_.front().begin;
        double end = puffs_.front().end;
        for (const RayPuff& puff : puffs_) {
            begin_ = std::min(begin_, puff.begin);
            end = std::max(end, puff.end);
        }
        const double count = std::ceil((end - begin_) / slabMetres_);
        if (count > maximumSlabs)
            throw std::invalid_argument(
                fmt::format("ground truth: slabs of {} m divide the {} m of a ray into more than {} parts", slabMetres_,
                            end - begin_, maximumSlabs));
        length_ = (end - begin_) / count;
        for (std::vector<double>* column : {&depths_, &reds_, &greens_, &blues_})
            column->assign(static_cast<std::size_t>(count), 0.0);
        for (const RayPuff& puff : puffs_) {
            // From the first to the last slab that the puff covers; the tails beyond are added to these two.
            const std::size_t first = slabOf(puff.begin), slabs = slabOf(puff.end) - first + 1;
            passed_.resize(slabs + 1);
            double* const passed = passed_.data();
            const double start = begin_ + static_cast<double>(first) * length_ - puff.foot;
            for (std::size_t k = 0; k <= slabs; ++k)
                passed[k] = halfErf_((start + static_cast<double>(k) * length_) * puff.inverseWidth);
            passed[0] = halfErf_(((puff.begin > 0 ? -infinite : 0.0) - puff.foot) * puff.inverseWidth);
            passed[slabs] =
                halfErf_(((puff.end < sceneMetres_ ? infinite : sceneMetres_) - puff.foot) * puff.inverseWidth);
            double *const depths = &depths_[first], *const reds = &reds_[first], *const greens = &greens_[first],
                          *const blues = &blues_[first];
            for (std::size_t k = 0; k < slabs; ++k) {
                const double depth = puff.depth * (passed[k + 1] - passed[k]);
                depths[k] += depth;
                reds[k] += depth * puff.colour.r;
                greens[k] += depth * puff.colour.g;
                blues[k] += depth * puff.colour.b;
            }
        }
    }

    [[nodiscard]] std::size_t slabOf(double metres) const {
        const double index = std::floor((metres - begin_) / length_);
        return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(depths_.size() - 1)));
    }

    static constexpr double infinite = 1e300;

    const maths::HalfErrorFunction& halfErf_ = maths::HalfErrorFunction::instance();
    double slabMetres_;
    double sceneMetres_ = 0;
    double begin_ = 0, length_ = 0;
    std::vector<RayPuff> puffs_;
    std::vector<double> depths_;                 ///< of each slab
    std::vector<double> reds_, greens_, blues_;  ///< weighted by depth
    std::vector<double> passed_;                 ///< share of a puff in front of each face of its slabs, minus one half
};

glm::dvec3 checkedColour(const Puffs& store, std::size_t i) {
    const glm::dvec3 colour(store.colour(i));
    if (!std::isfinite(colour.r + colour.g + colour.b))
        throw std::runtime_error(
            fmt::format("ground truth: particle {} has the colour ({}, {}, {}), expected finite numbers",
                        store.serial[i], colour.r, colour.g, colour.b));
    return colour;
}

CloudImage march(const Puffs& store, const scene::View& view, const OpaqueDistances& given,
                 const ReferenceOptions& options, const SunLight* light) {
    checkOptions(options);
    checkDistances(view, given);
    const CameraRays rays(view);
    const double neglected = neglectedDepth(options.toleratedDepth, store.size());
    const auto puffs = preparePuffs(store, rays, options.opticalDepthShare, neglected);
    const OpaqueDistances distances = options.ignoreScene ? skyDistances(view) : given;
    std::optional<Lighting> lighting;
    if (light)
        lighting.emplace(*light,
                         SunLattice(store, light->toSun, options.opticalDepthShare, neglected, 2 * options.slabMetres));

    std::vector<glm::dvec3> colours;
    colours.reserve(puffs.size());
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const Puff& puff : puffs) {
        colours.push_back(light && light->albedo ? *light->albedo : checkedColour(store, puff.index));
        low = glm::min(low, colours.back());
        high = glm::max(high, colours.back());
    }

    const auto width = static_cast<std::size_t>(view.width), height = static_cast<std::size_t>(view.height);
    CloudImage cloud{
        {view.width, view.height, std::vector<glm::vec4>(width * height)}, std::vector<double>(width * height), 0, 0};
    std::vector<double> unevenness(height, 0.0);
    std::atomic<std::int64_t> evaluations = 0;
    parallel::forEachBlock(height, 1, [&](std::size_t y, std::size_t) {
        const double slopeY = rays.rowSlope(static_cast<int>(y));
        std::vector<RowPuff> touching;
        for (std::size_t i = 0; i < puffs.size(); ++i) {
            const Puff& puff = puffs[i];
            if (static_cast<int>(y) < puff.firstRow || static_cast<int>(y) >= puff.endRow) continue;
            const RowGeometry geometry = rowGeometry(puff, slopeY);
            const Columns columns = columnsOf(puff, geometry, slopeY, rays);
            const double s = puff.deviationMetres;
            if (columns.first < columns.end)
                touching.push_back(
                    {&puff, geometry, columns, 1 / (2 * s * s), 1 / (std::numbers::sqrt2 * s), colours[i]});
        }
        RayMarch ray(options.slabMetres);
        std::int64_t done = 0;
        for (int x = 0; x < view.width; ++x) {
            const std::size_t pixel = y * width + static_cast<std::size_t>(x);
            const double slopeX = rays.columnSlope(x);
            ray.begin(distances.metres[pixel]);
            for (const RowPuff& puff : touching)
                if (x >= puff.columns.first && x < puff.columns.end)
                    ray.add(puff, slopeX, 1 / (1 + slopeX * slopeX + slopeY * slopeY));
            const MarchedPixel marched =
                ray.run(lighting ? &*lighting : nullptr, view.camera.eye, rays.direction(x, static_cast<int>(y)));
            done += static_cast<std::int64_t>(ray.size());
            cloud.opticalDepths[pixel] = marched.depth;
            cloud.image.pixels[pixel] = glm::vec4(glm::dvec4(marched.colour, -std::expm1(-marched.depth)));
            unevenness[y] = std::max(unevenness[y], marched.unevenness);
        }
        evaluations += done;
    });
    cloud.evaluations = evaluations;
    if (!puffs.empty()) {
        const glm::dvec3 range = high - low;
        cloud.colourErrorBound = *std::ranges::max_element(unevenness) * std::max({range.r, range.g, range.b});
    }
    return cloud;
}

}  // namespace

SunLight SunLight::of(const scene::Scene& scene) {
    const scene::Lights& lights = scene.lights;
    const glm::dvec3 sun(lights.sun), ambient(lights.ambient), all = ambient + sun / 4.0;
    const glm::dvec3 share(all.r > 0 ? 1 / all.r : 0, all.g > 0 ? 1 / all.g : 0, all.b > 0 ? 1 / all.b : 0);
    return {.toSun = glm::dvec3(lights.toSun),
            .sun = sun * share,
            .ambient = ambient * share,
            .asymmetry = static_cast<double>(scene.dustAsymmetry)};
}

CloudImage marchParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                          const ReferenceOptions& options) {
    return march(store, view, distances, options, nullptr);
}

CloudImage renderLitParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                              const SunLight& light, const ReferenceOptions& options) {
    return march(store, view, distances, options, &light);
}

}  // namespace dustbench::reference
