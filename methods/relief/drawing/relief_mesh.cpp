#include "methods/relief/drawing/relief_mesh.h"

#include <span>

namespace dustbench::relief {
namespace {

/// Appends the two triangles of a quadrilateral a, b, c, d.
void quadrilateral(std::vector<std::uint32_t>& indices, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                   std::uint32_t d) {
    indices.insert(indices.end(), {a, b, c, a, c, d});
}

std::vector<std::uint32_t> indicesOf(std::uint32_t columns, std::uint32_t rows) {
    const std::uint32_t bottom = columns * rows, top = (rows - 1) * columns, right = columns - 1;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t row = 0; row + 1 < rows; ++row)
        for (std::uint32_t n = row * columns; n < row * columns + right; ++n)
            quadrilateral(indices, n, n + 1, n + columns + 1, n + columns);
    const auto rim = [&](std::uint32_t first, std::uint32_t spacing, std::uint32_t count) {
        for (std::uint32_t k = 0; k + 1 < count; ++k) {
            const std::uint32_t n = first + k * spacing;
            quadrilateral(indices, n, n + spacing, n + spacing + bottom, n + bottom);
        }
    };
    rim(0, 1, columns);
    rim(top, 1, columns);
    rim(0, columns, rows);
    rim(right, columns, rows);
    quadrilateral(indices, bottom, bottom + right, bottom + top + right, bottom + top);
    return indices;
}

}  // namespace

ReliefMesh::ReliefMesh(gpu::Device& device, int columns, int rows)
    : vertices_(device), triangles_(2 * (columns + 1) * (rows + 1), 2 * (columns + 1), 2 * (rows + 1)) {
    const std::vector<std::uint32_t> indices =
        indicesOf(static_cast<std::uint32_t>(columns) + 2, static_cast<std::uint32_t>(rows) + 2);
    indexCount_ = static_cast<int>(indices.size());
    indices_ = gpu::Buffer(device, "relief mesh", std::span<const std::uint32_t>(indices));
    vertices_.indices(indices_);
}

}  // namespace dustbench::relief
