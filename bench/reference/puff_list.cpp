#include "bench/reference/puff_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "methods/contract/volume.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::reference {
namespace {

void check(const Puffs& store, std::size_t i) {
    const bool finite = std::isfinite(store.x[i]) && std::isfinite(store.y[i]) && std::isfinite(store.z[i]) &&
                        std::isfinite(store.radius[i]) && std::isfinite(store.opacity[i]);
    if (finite && store.radius[i] >= 0 && store.opacity[i] >= 0 && store.opacity[i] < 1) return;
    throw std::runtime_error(
        fmt::format("ground truth: particle {} is not a puff: position ({}, {}, {}), radius {}, opacity {}; allowed: "
                    "finite numbers, a radius of 0 or more and an opacity of at least 0 and less than 1",
                    store.serial[i], store.x[i], store.y[i], store.z[i], store.radius[i], store.opacity[i]));
}

/// Range of slopes at which the half-plane through the camera's other axis meets the sphere of radius R around the
/// centre; `aside` and `ahead` are its two relevant coordinates. All slopes unless the sphere is wholly ahead.
struct Slopes {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};
Slopes slopesOf(double aside, double ahead, double reach) {
    if (!(ahead > reach)) return {};
    const double root = reach * std::sqrt(aside * aside + ahead * ahead - reach * reach);
    const double scale = 1 / ((ahead - reach) * (ahead + reach));
    return {(aside * ahead - root) * scale, (aside * ahead + root) * scale};
}

/// The pixels whose centres lie between two pixel coordinates, slightly widened, within 0..count.
Columns pixelsBetween(double low, double high, int count) {
    const double limit = count;
    // The order of the arguments turns NaN into the widest bound.
    const double first = std::clamp(std::floor(std::max(0.0, low) - 0.5), 0.0, limit);
    const double end = std::clamp(std::ceil(std::min(limit, high) + 0.5), 0.0, limit);
    if (!(first < end)) return {0, 0};
    return {static_cast<int>(first), static_cast<int>(end)};
}

}  // namespace

double neglectedDepth(double toleratedDepth, std::size_t puffs) {
    return toleratedDepth / static_cast<double>(std::max<std::size_t>(puffs, 1));
}

std::vector<Puff> preparePuffs(const Puffs& store, const CameraRays& rays, double opticalDepthShare, double neglected) {
    std::vector<Puff> puffs;
    puffs.reserve(store.size());
    for (std::size_t i = 0; i < store.size(); ++i) {
        check(store, i);
        const double s = maths::puffDeviationMetres(static_cast<double>(store.radius[i]));
        const double tau = opticalDepthShare * maths::puffOpticalDepth(static_cast<double>(store.opacity[i]));
        if (!(s > 0) || !(tau > neglected)) continue;
        const double reach = s * std::sqrt(2 * std::log(tau / neglected));
        const glm::dvec3 centre = rays.fromWorld(glm::dvec3(store.position(i)));
        if (centre.z < -reach) continue;
        const Slopes up = slopesOf(centre.y, centre.z, reach);
        const Columns rows = pixelsBetween(rays.pixelY(up.high), rays.pixelY(up.low), rays.height());
        const Slopes aside = slopesOf(centre.x, centre.z, reach);
        const Columns columns = pixelsBetween(rays.pixelX(aside.low), rays.pixelX(aside.high), rays.width());
        if (rows.first == rows.end || columns.first == columns.end) continue;
        puffs.push_back({centre, s, tau, reach, rows.first, rows.end, static_cast<std::uint32_t>(i)});
    }
    return puffs;
}

RowGeometry rowGeometry(const Puff& puff, double slopeY) {
    const double x = puff.centre.x, y = puff.centre.y, z = puff.centre.z;
    // c × (X, Y, 1) = a + X·b with a = (y − zY, −x, xY) and b = (0, z, −y).
    const double gamma = y * y + z * z;
    const double foot = z + y * slopeY;
    const double lift = y - z * slopeY;
    if (!(gamma > 0)) return {0, 0, x * x * (1 + slopeY * slopeY), foot, x};
    return {gamma, x * foot / gamma, lift * lift * (1 + x * x / gamma), foot, x};
}

Columns columnsOf(const Puff& puff, const RowGeometry& row, double slopeY, const CameraRays& rays) {
    const Columns all{0, rays.width()};
    const double squareReach = puff.reachMetres * puff.reachMetres;
    if (glm::dot(puff.centre, puff.centre) <= squareReach) return all;
    // b ≤ R: γ·(X − X0)² + κ ≤ R²·(1 + X² + Y²), that is A·X² − 2·B·X + C ≤ 0.
    const double a = row.gamma - squareReach;
    const double b = row.gamma * row.x0;
    const double c = b * row.x0 + row.kappa - squareReach * (1 + slopeY * slopeY);
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return a > 0 ? Columns{0, 0} : all;
    const double q = b + std::copysign(std::sqrt(discriminant), b);
    const double low = std::min(q / a, c / q), high = std::max(q / a, c / q);
    if (a >= 0) {
        // The whole interval lies on one side of the eye: ahead, or on the rays' backward extensions.
        if (row.footAtZero + row.footPerSlope * (b / a) <= 0) return {0, 0};
        return pixelsBetween(rays.pixelX(low), rays.pixelX(high), rays.width());
    }
    // The camera's x axis itself meets the sphere: slopes beyond one root meet it ahead, those beyond the other behind.
    if (puff.centre.x > 0) return pixelsBetween(rays.pixelX(high), rays.width(), rays.width());
    return pixelsBetween(0, rays.pixelX(low), rays.width());
}

}  // namespace dustbench::reference
