#include "methods/kit/draw/ground_lattice.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace dustbench::draw {
namespace {

constexpr double reachMetres = 30e3;  // haze hides the ground well before this distance
constexpr int flatCellsAcross = 8;
constexpr int reliefCellsAcross = 48;
constexpr int blockCells = 8;

}  // namespace

GroundLattice::GroundLattice(const scene::Terrain& terrain) : terrain_(terrain) {
    if (!terrain.isFlat()) {
        across_ = reliefCellsAcross;
        // Cells of about a metre: finer than coarse samples, so that two triangles approximate the bilinear form in
        // between.
        cellMetres_ = static_cast<double>(terrain.spacingMetres());
        while (cellMetres_ > 1.5) cellMetres_ /= 2;
        while (cellMetres_ < 0.75) cellMetres_ *= 2;
    } else {
        across_ = flatCellsAcross;
    }
    const std::int64_t cellsToRim = across_ / 2;
    while (static_cast<double>(cellsToRim * stride(levels_ - 1)) * cellMetres_ < reachMetres) ++levels_;
}

std::int64_t GroundLattice::centreOf(int level, double coordinate, double origin) const {
    // A step of twice the ring's stride keeps its rim on the next ring's lattice. The inner rings share one step, so
    // that a moving camera does not rebuild them every metre.
    const auto shared = static_cast<std::int64_t>(std::bit_floor(static_cast<unsigned>(across_ / 8)));
    const std::int64_t step = std::max(shared, 2 * stride(level));
    const double cells = (coordinate - origin) / cellMetres_;
    return static_cast<std::int64_t>(std::floor(cells / static_cast<double>(step) + 0.5)) * step;
}

bool GroundLattice::moveTo(const glm::dvec3& eye) {
    const glm::dvec2 origin(terrain_.origin());
    std::vector<Corner> corners;
    for (int level = 0; level < levels_; ++level) {
        const std::int64_t half = across_ / 2 * stride(level);
        corners.push_back({centreOf(level, eye.x, origin.x) - half, centreOf(level, eye.z, origin.y) - half});
    }
    const auto same = [](const Corner& a, const Corner& b) { return a.x == b.x && a.z == b.z; };
    if (std::equal(corners.begin(), corners.end(), corners_.begin(), corners_.end(), same)) return false;
    corners_ = std::move(corners);

    anchorX_ = corners_[0].x + across_ / 2;
    anchorZ_ = corners_[0].z + across_ / 2;
    anchor_ = {origin.x + static_cast<double>(anchorX_) * cellMetres_, 0,
               origin.y + static_cast<double>(anchorZ_) * cellMetres_};
    vertices_.clear();
    indices_.clear();
    blocks_.clear();
    for (int level = 0; level < levels_; ++level) makeVertices(level);
    for (int level = 0; level < levels_; ++level)
        for (int row = 0; row < across_; row += blockCells)
            for (int column = 0; column < across_; column += blockCells) makeBlock(level, column, row);
    return true;
}

glm::vec3 GroundLattice::normalAt(double x, double z, double step) const {
    const auto height = [&](double a, double b) {
        return terrain_.heightAt(static_cast<float>(a), static_cast<float>(b));
    };
    // n ∝ (−∂h/∂x, 1, −∂h/∂z) by central differences
    const auto twoSteps = static_cast<float>(2 * step);
    return glm::normalize(
        glm::vec3(height(x - step, z) - height(x + step, z), twoSteps, height(x, z - step) - height(x, z + step)));
}

void GroundLattice::makeVertices(int level) {
    const std::int64_t step = stride(level);
    const bool flat = terrain_.isFlat();
    const double slopeStep =
        std::max(static_cast<double>(step) * cellMetres_, static_cast<double>(terrain_.spacingMetres()));
    for (int j = 0; j <= across_; ++j)
        for (int i = 0; i <= across_; ++i) {
            const double x =
                static_cast<double>(corners_[static_cast<std::size_t>(level)].x + i * step - anchorX_) * cellMetres_;
            const double z =
                static_cast<double>(corners_[static_cast<std::size_t>(level)].z + j * step - anchorZ_) * cellMetres_;
            const double worldX = anchor_.x + x;
            const double worldZ = anchor_.z + z;
            const float y = terrain_.heightAt(static_cast<float>(worldX), static_cast<float>(worldZ));
            const glm::vec3 normal = flat ? glm::vec3(0, 1, 0) : normalAt(worldX, worldZ, slopeStep);
            vertices_.push_back({{static_cast<float>(x), y, static_cast<float>(z)}, normal});
        }
}

std::uint32_t GroundLattice::vertexOf(int level, int i, int j) const {
    // Odd rim vertices do not exist in the next ring: snap each to its neighbour, so that both rings share their edges
    // and leave no cracks.
    if ((j == 0 || j == across_) && i % 2 == 1) --i;
    if ((i == 0 || i == across_) && j % 2 == 1) --j;
    const int side = across_ + 1;
    return static_cast<std::uint32_t>((level * side + j) * side + i);
}

void GroundLattice::makeBlock(int level, int firstColumn, int firstRow) {
    const Corner& corner = corners_[static_cast<std::size_t>(level)];
    const std::int64_t step = stride(level);
    const auto inFinerRing = [&](int i, int j) {
        if (level == 0) return false;
        const Corner& hole = corners_[static_cast<std::size_t>(level - 1)];
        const std::int64_t side = across_ * stride(level - 1);
        const std::int64_t x = corner.x + i * step - hole.x;
        const std::int64_t z = corner.z + j * step - hole.z;
        return x >= 0 && x < side && z >= 0 && z < side;
    };
    Block block{glm::vec3(INFINITY), glm::vec3(-INFINITY), indices_.size(), 0};
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == b || b == c || c == a) return;
        for (const std::uint32_t index : {a, b, c}) {
            indices_.push_back(index);
            block.minimum = glm::min(block.minimum, vertices_[index].position);
            block.maximum = glm::max(block.maximum, vertices_[index].position);
        }
    };
    for (int j = firstRow; j < std::min(firstRow + blockCells, across_); ++j)
        for (int i = firstColumn; i < std::min(firstColumn + blockCells, across_); ++i) {
            if (inFinerRing(i, j)) continue;
            const std::uint32_t a = vertexOf(level, i, j), b = vertexOf(level, i + 1, j);
            const std::uint32_t c = vertexOf(level, i, j + 1), d = vertexOf(level, i + 1, j + 1);
            triangle(a, c, d);
            triangle(a, d, b);
        }
    block.lastIndex = indices_.size();
    if (block.lastIndex > block.firstIndex) blocks_.push_back(block);
}

void GroundLattice::appendVisible(const glm::mat4& anchorToClip, std::vector<std::uint32_t>& indices) const {
    const glm::mat4 rows = glm::transpose(anchorToClip);
    // Inside the view: −w ≤ x ≤ w, −w ≤ y ≤ w and z ≤ w (z > w is nearer than the near plane).
    const std::array<glm::vec4, 5> planes{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                                          rows[3] - rows[2]};
    for (const Block& block : blocks_) {
        const bool outside = std::any_of(planes.begin(), planes.end(), [&](const glm::vec4& plane) {
            const glm::vec3 farthest(plane.x > 0 ? block.maximum.x : block.minimum.x,
                                     plane.y > 0 ? block.maximum.y : block.minimum.y,
                                     plane.z > 0 ? block.maximum.z : block.minimum.z);
            return glm::dot(glm::vec3(plane), farthest) + plane.w < 0;
        });
        if (!outside)
            indices.insert(indices.end(), indices_.begin() + static_cast<std::ptrdiff_t>(block.firstIndex),
                           indices_.begin() + static_cast<std::ptrdiff_t>(block.lastIndex));
    }
}

void GroundLattice::appendWithin(std::span<const GroundRectangle> rectangles,
                                 std::vector<std::uint32_t>& indices) const {
    const glm::dvec2 centre(anchor_.x, anchor_.z);
    const auto touches = [&](const GroundRectangle& rectangle, const glm::vec3& low, const glm::vec3& high) {
        const glm::vec2 minimum(rectangle.minimum - centre), maximum(rectangle.maximum - centre);
        return high.x >= minimum.x && low.x <= maximum.x && high.z >= minimum.y && low.z <= maximum.y;
    };
    std::vector<GroundRectangle> nearby;
    for (const Block& block : blocks_) {
        nearby.clear();
        for (const GroundRectangle& rectangle : rectangles)
            if (touches(rectangle, block.minimum, block.maximum)) nearby.push_back(rectangle);
        if (nearby.empty()) continue;
        for (std::size_t i = block.firstIndex; i < block.lastIndex; i += 3) {
            const glm::vec3& a = vertices_[indices_[i]].position;
            const glm::vec3& b = vertices_[indices_[i + 1]].position;
            const glm::vec3& c = vertices_[indices_[i + 2]].position;
            const glm::vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
            if (std::any_of(nearby.begin(), nearby.end(), [&](const auto& each) { return touches(each, low, high); }))
                indices.insert(indices.end(), indices_.begin() + static_cast<std::ptrdiff_t>(i),
                               indices_.begin() + static_cast<std::ptrdiff_t>(i) + 3);
        }
    }
}

}  // namespace dustbench::draw
