#include "methods/kit/particles/attraction.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::particles {
namespace {

constexpr std::uint32_t bodiesPerLeaf = 8, bodiesPerGroup = 32;
constexpr int levels = 21;  // bits of a Morton code along each axis

/// Two bodies at a time, so that each point is loaded and stored half as often; the order of addition is unchanged.
template <AttractionLaw law>
void addPullOf(const Bodies& bodies, std::size_t count, const float* __restrict x, const float* __restrict y,
               const float* __restrict z, float* __restrict accelerationX, float* __restrict accelerationY,
               float* __restrict accelerationZ, float strength, float softening2) {
    const std::size_t even = bodies.x.size() & ~std::size_t{1};
    for (std::size_t j = 0; j < even; j += 2) {
        const float xj = bodies.x[j], yj = bodies.y[j], zj = bodies.z[j], mj = strength * bodies.mass[j];
        const float xk = bodies.x[j + 1], yk = bodies.y[j + 1], zk = bodies.z[j + 1],
                    mk = strength * bodies.mass[j + 1];
        for (std::size_t i = 0; i < count; ++i) {
            const float ax = xj - x[i], ay = yj - y[i], az = zj - z[i];
            const float bx = xk - x[i], by = yk - y[i], bz = zk - z[i];
            const float a = mj * pullPerMetre<law>(ax * ax + ay * ay + az * az + softening2);
            const float b = mk * pullPerMetre<law>(bx * bx + by * by + bz * bz + softening2);
            accelerationX[i] = accelerationX[i] + a * ax + b * bx;
            accelerationY[i] = accelerationY[i] + a * ay + b * by;
            accelerationZ[i] = accelerationZ[i] + a * az + b * bz;
        }
    }
    for (std::size_t j = even; j < bodies.x.size(); ++j)
        for (std::size_t i = 0; i < count; ++i) {
            const float ax = bodies.x[j] - x[i], ay = bodies.y[j] - y[i], az = bodies.z[j] - z[i];
            const float a = strength * bodies.mass[j] * pullPerMetre<law>(ax * ax + ay * ay + az * az + softening2);
            accelerationX[i] += a * ax;
            accelerationY[i] += a * ay;
            accelerationZ[i] += a * az;
        }
}

/// Inserts two zero bits before each of 21 bits.
std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 32) & 0x001f00000000ffffULL;
    v = (v | v << 16) & 0x001f0000ff0000ffULL;
    v = (v | v << 8) & 0x100f00f00f00f00fULL;
    v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
    v = (v | v << 2) & 0x1249249249249249ULL;
    return v;
}

struct Box {
    std::array<float, 3> minimum{INFINITY, INFINITY, INFINITY}, maximum{-INFINITY, -INFINITY, -INFINITY};

    void hold(std::size_t axis, std::span<const float> values) {
        for (const float v : values) {
            minimum[axis] = std::min(minimum[axis], v);
            maximum[axis] = std::max(maximum[axis], v);
        }
    }
    [[nodiscard]] float distance2(float x, float y, float z) const {
        const std::array point{x, y, z};
        float sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float away = std::max({minimum[k] - point[k], point[k] - maximum[k], 0.0f});
            sum += away * away;
        }
        return sum;
    }
};

Box boxOf(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    Box box;
    box.hold(0, x);
    box.hold(1, y);
    box.hold(2, z);
    return box;
}

}  // namespace

void addPull(const Attraction& attraction, const Bodies& bodies, const Attracted& points) {
    withLaw(attraction.law, [&]<AttractionLaw law>() {
        addPullOf<law>(bodies, points.count, points.x, points.y, points.z, points.accelerationX, points.accelerationY,
                       points.accelerationZ, attraction.strength,
                       attraction.softeningMetres * attraction.softeningMetres);
    });
}

/// The bodies and cells that attract one group.
struct AttractionTree::Sources {
    std::vector<float> x, y, z, mass;

    void clear() {
        for (auto* column : {&x, &y, &z, &mass}) column->clear();
    }
    void add(float atX, float atY, float atZ, float m) {
        x.push_back(atX);
        y.push_back(atY);
        z.push_back(atZ);
        mass.push_back(m);
    }
};

void AttractionTree::build(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    cells_.clear();
    groups_.clear();
    const std::size_t count = x.size();
    order_.resize(count);
    for (auto* column : {&x_, &y_, &z_}) column->resize(count);
    if (count == 0) return;
    const Box box = boxOf(x, y, z);
    float edge = 0;
    for (std::size_t k = 0; k < 3; ++k) edge = std::max(edge, box.maximum[k] - box.minimum[k]);
    const double perMetre = edge > 0 ? ((1 << levels) - 1) / static_cast<double>(edge) : 0;
    const auto digits = [&](float v, std::size_t axis) {
        return spread(static_cast<std::uint64_t>(static_cast<double>(v - box.minimum[axis]) * perMetre));
    };
    parallel::forEachBlock(count, 8192, [&](std::size_t first, std::size_t size) {
        for (std::size_t i = first; i < first + size; ++i)
            order_[i] = {digits(x[i], 0) | digits(y[i], 1) << 1 | digits(z[i], 2) << 2, static_cast<std::uint32_t>(i)};
    });
    std::sort(order_.begin(), order_.end());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t from = order_[i].second;
        x_[i] = x[from], y_[i] = y[from], z_[i] = z[from];
    }
    addCell(0, static_cast<std::uint32_t>(count), 0, edge);
}

/// Appends the cell of a run of bodies, and its descendants; skips cells with a single child. Returns the sum of its
/// bodies' positions.
AttractionTree::Sum AttractionTree::addCell(std::uint32_t first, std::uint32_t count, int level, float edge) {
    const auto place = static_cast<std::uint32_t>(cells_.size());
    const auto shiftOf = [](int atLevel) { return 3 * (levels - 1 - atLevel); };
    while (level < levels &&
           order_[first].first >> shiftOf(level) == order_[first + count - 1].first >> shiftOf(level)) {
        ++level;
        edge /= 2;
    }
    const bool isLeaf = count <= bodiesPerLeaf || level == levels;
    cells_.push_back({0, 0, 0, static_cast<float>(count), edge, first, count, 0, isLeaf});
    // A leaf with more bodies than a group, all at one position, is divided among several walks (see `pull`).
    const bool endsGroup = isLeaf || count <= bodiesPerGroup;
    const bool isWithinGroup = !groups_.empty() && first < cells_[groups_.back()].first + cells_[groups_.back()].count;
    if (endsGroup && !isWithinGroup) groups_.push_back(place);
    Sum sum;
    if (isLeaf) {
        for (std::uint32_t i = first; i < first + count; ++i)
            sum = {sum.x + static_cast<double>(x_[i]), sum.y + static_cast<double>(y_[i]),
                   sum.z + static_cast<double>(z_[i])};
    } else {
        const int shift = shiftOf(level);
        const auto digit = [&](std::uint32_t i) { return order_[i].first >> shift; };
        for (std::uint32_t i = first; i < first + count;) {
            const auto end = std::partition_point(order_.begin() + i, order_.begin() + first + count,
                                                  [&](const auto& entry) { return entry.first >> shift == digit(i); });
            const auto last = static_cast<std::uint32_t>(end - order_.begin());
            const Sum part = addCell(i, last - i, level + 1, edge / 2);
            sum = {sum.x + part.x, sum.y + part.y, sum.z + part.z};
            i = last;
        }
    }
    Cell& cell = cells_[place];
    cell.x = static_cast<float>(sum.x / count);
    cell.y = static_cast<float>(sum.y / count);
    cell.z = static_cast<float>(sum.z / count);
    cell.next = static_cast<std::uint32_t>(cells_.size());
    return sum;
}

void AttractionTree::collect(const Cell& group, float openingAngle, FarBodies farBodies, Sources& sources) const {
    sources.clear();
    const auto within = [&](const std::vector<float>& v) { return std::span(v).subspan(group.first, group.count); };
    const Box box = boxOf(within(x_), within(y_), within(z_));
    const float angle2 = openingAngle * openingAngle;
    for (std::uint32_t c = 0; c < cells_.size();) {
        const Cell& cell = cells_[c];
        if (cell.edge * cell.edge < angle2 * box.distance2(cell.x, cell.y, cell.z)) {
            if (farBodies == FarBodies::centreOfMass) sources.add(cell.x, cell.y, cell.z, cell.mass);
            c = cell.next;
        } else if (cell.isLeaf) {
            for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) sources.add(x_[i], y_[i], z_[i], 1);
            c = cell.next;
        } else {
            ++c;
        }
    }
}

void AttractionTree::pull(const Attraction& attraction, float openingAngle, FarBodies farBodies,
                          std::span<float> accelerationX, std::span<float> accelerationY,
                          std::span<float> accelerationZ) const {
    parallel::forEachBlock(groups_.size(), 16, [&](std::size_t firstGroup, std::size_t groups) {
        Sources sources;
        for (std::size_t g = firstGroup; g < firstGroup + groups; ++g) {
            const Cell& group = cells_[groups_[g]];
            collect(group, openingAngle, farBodies, sources);
            const Bodies bodies{sources.x, sources.y, sources.z, sources.mass};
            for (std::uint32_t begin = 0; begin < group.count; begin += bodiesPerGroup) {
                const std::uint32_t first = group.first + begin, count = std::min(bodiesPerGroup, group.count - begin);
                alignas(64) std::array<float, bodiesPerGroup> ax{}, ay{}, az{};
                addPull(attraction, bodies,
                        {count, &x_[first], &y_[first], &z_[first], ax.data(), ay.data(), az.data()});
                for (std::uint32_t i = 0; i < count; ++i) {
                    const std::uint32_t to = order_[first + i].second;
                    accelerationX[to] = ax[i], accelerationY[to] = ay[i], accelerationZ[to] = az[i];
                }
            }
        }
    });
}

std::int64_t AttractionTree::pairs(float openingAngle, FarBodies farBodies) const {
    std::atomic<std::int64_t> sum{0};
    parallel::forEachBlock(groups_.size(), 64, [&](std::size_t first, std::size_t count) {
        Sources sources;
        for (std::size_t g = first; g < first + count; ++g) {
            const Cell& group = cells_[groups_[g]];
            collect(group, openingAngle, farBodies, sources);
            sum += static_cast<std::int64_t>(sources.x.size()) * group.count;
        }
    });
    return sum;
}

std::size_t AttractionTree::bytes() const {
    return cells_.capacity() * sizeof(Cell) + groups_.capacity() * sizeof(std::uint32_t) +
           order_.capacity() * sizeof(order_.front()) + (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(float);
}

}  // namespace dustbench::particles
