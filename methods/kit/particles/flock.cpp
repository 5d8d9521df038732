#include "methods/kit/particles/flock.h"

#include "methods/kit/lanes/lanes.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::particles {
namespace {

using lanes::Float16;
using lanes::Int16;
constexpr std::size_t gridBlock = 8192, flockBlock = 512, flockLanes = 16;
constexpr double densePoints = 16;
constexpr Int16 laneNumbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// FlockSums of 16 neighbours at a time; velocities of the neighbours, not relative.
struct LaneSums {
    Float16 apartX{}, apartY{}, apartZ{}, offsetX{}, offsetY{}, offsetZ{}, velocityX{}, velocityY{}, velocityZ{};
    Int16 seen{};
};

using FlockColumns = std::array<std::vector<float>, 6>;

[[gnu::always_inline]] inline Float16 where(const Int16& mask, const Float16& value) {
    return mask ? value : Float16{};
}

/// `hasNear`: false only if no point of the run is near.
template <bool hasNear>
[[gnu::always_inline]] inline void addRun(const FlockColumns& c, const PointGrid::Run& run, const glm::vec3& self,
                                          float near2, float reach2, LaneSums& s) {
    for (std::uint32_t k = run.first; k < run.end; k += flockLanes) {
        const Float16 x = lanes::load<Float16>(&c[0][k]) - self.x, y = lanes::load<Float16>(&c[1][k]) - self.y,
                      z = lanes::load<Float16>(&c[2][k]) - self.z;
        const Float16 squared = x * x + y * y + z * z;
        const Int16 sees = (squared < reach2) & (squared > 0.0f) & (laneNumbers < static_cast<int>(run.end - k));
        if constexpr (hasNear) {
            const Int16 isNear = sees & (squared < near2);
            const Float16 inverse = 1.0f / squared;
            s.apartX -= where(isNear, x * inverse);
            s.apartY -= where(isNear, y * inverse);
            s.apartZ -= where(isNear, z * inverse);
        }
        s.offsetX += where(sees, x);
        s.offsetY += where(sees, y);
        s.offsetZ += where(sees, z);
        s.velocityX += where(sees, lanes::load<Float16>(&c[3][k]));
        s.velocityY += where(sees, lanes::load<Float16>(&c[4][k]));
        s.velocityZ += where(sees, lanes::load<Float16>(&c[5][k]));
        s.seen -= sees;
    }
}

/// In halves, so that the order is that of the machine's shuffles and the same everywhere.
template <typename Vector>
[[gnu::always_inline]] inline auto sumOf(const Vector& vector) {
    auto v = vector;
    for (int half = flockLanes / 2; half > 0; half /= 2)
        for (int i = 0; i < half; ++i) v[i] += v[i + half];
    return v[0];
}

FlockSums total(const LaneSums& s, const glm::vec3& velocity) {
    FlockSums sums;
    sums.seen = static_cast<float>(sumOf(s.seen));
    if (sums.seen == 0) return sums;
    sums.apart = {sumOf(s.apartX), sumOf(s.apartY), sumOf(s.apartZ)};
    sums.offset = {sumOf(s.offsetX), sumOf(s.offsetY), sumOf(s.offsetZ)};
    sums.velocity = glm::vec3(sumOf(s.velocityX), sumOf(s.velocityY), sumOf(s.velocityZ)) - sums.seen * velocity;
    return sums;
}

}  // namespace

void PointGrid::chooseCells(std::span<const float> x, std::span<const float> y, std::span<const float> z,
                            float reachMetres) {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const glm::vec3 p(x[i], y[i], z[i]);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    minimum_ = low;
    const double most = 4 * static_cast<double>(x.size()) + 64;
    const glm::dvec3 extent(high - low);
    const auto reach = static_cast<double>(reachMetres);
    // Few points in a cube of the reach: larger cells give fewer and longer runs. Many: smaller ones hold fewer others.
    const glm::dvec3 cubes = glm::max(extent / reach, 1.0);
    const bool dense = static_cast<double>(x.size()) > densePoints * cubes.x * cubes.y * cubes.z;
    double edge = dense ? reach / 2 : reach;
    const auto cellsAt = [&] { return glm::floor(extent / edge) + 1.0; };
    for (glm::dvec3 cells = cellsAt(); cells.x * cells.y * cells.z > most && edge < 1e30; cells = cellsAt())
        edge *= 1.25;
    perEdge_ = static_cast<float>(1 / edge);
    const glm::dvec3 cells = cellsAt();
    cells_ = cells.x * cells.y * cells.z <= most ? glm::ivec3(cells) : glm::ivec3(1);
    slack_ = 0.01f + 5e-7f * static_cast<float>(std::max({cells_.x, cells_.y, cells_.z}));
    reach_ = reachMetres + static_cast<float>(static_cast<double>(slack_) * edge);
}

void PointGrid::build(std::span<const float> x, std::span<const float> y, std::span<const float> z, float reachMetres) {
    const std::size_t count = x.size();
    for (auto* column : {&cellOfPoint_, &order_}) column->resize(count);
    chooseCells(x, y, z, reachMetres);
    parallel::forEachBlock(count, gridBlock, [&](std::size_t first, std::size_t number) {
        for (std::size_t i = first; i < first + number; ++i) {
            const int column = cellAlong(x[i], 0);
            const int row = cellAlong(y[i], 1);
            const int layer = cellAlong(z[i], 2);
            cellOfPoint_[i] = static_cast<std::uint32_t>(column + cells_.x * (row + cells_.y * layer));
        }
    });
    begin_.assign(
        static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z) +
            1,
        0);
    for (const std::uint32_t cell : cellOfPoint_) ++begin_[cell + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    // Each point takes the next place of its cell, which moves the beginnings; they are moved back afterwards.
    for (std::size_t i = 0; i < count; ++i) {
        order_[begin_[cellOfPoint_[i]]++] = static_cast<std::uint32_t>(i);
    }
    std::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
    begin_[0] = 0;
}

std::size_t PointGrid::bytes() const {
    return (cellOfPoint_.capacity() + order_.capacity() + begin_.capacity()) * sizeof(std::uint32_t);
}

void Flock::accelerate(const FlockRules& rules, const FlockState& s, std::span<glm::vec3> accelerations) {
    grid_.build(s.x, s.y, s.z, rules.sightMetres);
    const std::array from{s.x, s.y, s.z, s.velocityX, s.velocityY, s.velocityZ};
    for (auto& column : columns_) column.resize(s.x.size() + flockLanes);
    parallel::forEachBlock(s.x.size(), 8192, [&](std::size_t first, std::size_t count) {
        for (std::size_t c = 0; c < from.size(); ++c)
            for (std::size_t place = first; place < first + count; ++place)
                columns_[c][place] = from[c][grid_.order()[place]];
    });
    const float near2 = rules.nearMetres * rules.nearMetres, reach2 = rules.sightMetres * rules.sightMetres;
    parallel::forEachBlock(s.x.size(), flockBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t place = first; place < first + count; ++place) {
            const glm::vec3 self(columns_[0][place], columns_[1][place], columns_[2][place]);
            LaneSums sums;
            grid_.forEachRun(self, [&](const PointGrid::Run& run) {
                if (run.away2 < near2)
                    addRun<true>(columns_, run, self, near2, reach2, sums);
                else
                    addRun<false>(columns_, run, self, near2, reach2, sums);
            });
            const glm::vec3 velocity(columns_[3][place], columns_[4][place], columns_[5][place]);
            accelerations[grid_.order()[place]] = total(sums, velocity).acceleration(rules);
        }
    });
}

void accelerateOneByOne(const FlockRules& rules, const FlockState& s, std::span<glm::vec3> accelerations) {
    const float reach2 = rules.sightMetres * rules.sightMetres;
    PointGrid grid;
    grid.build(s.x, s.y, s.z, rules.sightMetres);
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        const glm::vec3 self(s.x[i], s.y[i], s.z[i]), velocity(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
        FlockSums sums;
        grid.forEachRun(self, [&](const PointGrid::Run& run) {
            for (std::uint32_t k = run.first; k < run.end; ++k) {
                const std::uint32_t j = grid.order()[k];
                const glm::vec3 to = glm::vec3(s.x[j], s.y[j], s.z[j]) - self;
                const float squared = glm::dot(to, to);
                if (squared < reach2 && squared > 0)
                    sums.add(to, glm::vec3(s.velocityX[j], s.velocityY[j], s.velocityZ[j]) - velocity, squared, rules);
            }
        });
        accelerations[i] = sums.acceleration(rules);
    }
}

void accelerateByAllPairs(const FlockRules& rules, const FlockState& s, std::span<glm::vec3> accelerations) {
    const std::size_t count = s.x.size();
    const float reach2 = rules.sightMetres * rules.sightMetres;
    for (std::size_t i = 0; i < count; ++i) {
        FlockSums sums;
        for (std::size_t j = 0; j < count; ++j) {
            const glm::vec3 to(s.x[j] - s.x[i], s.y[j] - s.y[i], s.z[j] - s.z[i]);
            const float squared = glm::dot(to, to);
            if (squared < reach2 && squared > 0)
                sums.add(
                    to,
                    {s.velocityX[j] - s.velocityX[i], s.velocityY[j] - s.velocityY[i], s.velocityZ[j] - s.velocityZ[i]},
                    squared, rules);
        }
        accelerations[i] = sums.acceleration(rules);
    }
}

}  // namespace dustbench::particles
