// Draws the particles of one or several shapes as points, lines, sprites or billboards.
//
// Several shapes are merged into one list (MergedParticles), which is sorted (DrawOrder), uploaded and drawn
// (ShapePicture).
//
// Units: metres. Owns: its lists, on a ledger; the passes and their textures. Threads: the OpenGL thread's; the order
// does not depend on the number of threads. Source: JuckelBeckhaus2007, 4.4.
#pragma once

#include <optional>
#include <span>

#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/draw/points.h"
#include "methods/voxel_shape/living_shape.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Merges the particles of several shapes into one list, to sort and draw them together. Holds nothing if there is only
/// one shape.
class MergedParticles {
 public:
    explicit MergedParticles(MemoryLedger& ledger) : all_(ledger) {}

    /// Returns the particles of the only shape, or a copy of all: positions, velocities, looks and pictures. Valid
    /// until the next call or step.
    [[nodiscard]] const ShapeParticles& of(std::span<LivingShape> shapes);

 private:
    ShapeParticles all_;
};

/// The order in which particles are blended: sorted fully, partly, every few frames, or not at all (the paper:
/// `sometimes it is sufficient to just sort parts of the particles`).
class DrawOrder {
 public:
    explicit DrawOrder(MemoryLedger& ledger);

    /// Returns the indices of the points in blending order. Valid until the next call.
    std::span<const std::uint32_t> of(const Look& look, const draw::PointColumns& points, const glm::vec3& eye);

 private:
    std::span<const std::uint32_t> nearestSorted(std::size_t nearest, const draw::PointColumns& points,
                                                 const glm::vec3& eye);
    std::span<const std::uint32_t> sortedNowAndThen(std::uint32_t every, const draw::PointColumns& points,
                                                    const glm::vec3& eye);

    draw::DepthSort sort_;
    LedgerVector<float> depths_, chosenDepths_;
    LedgerVector<std::uint32_t> order_, chosen_;
    std::uint32_t calls_ = 0;
};

class ShapePicture {
 public:
    ShapePicture(gpu::Device& device, const Look& look);

    /// Copies the particles to the GPU in this order.
    void upload(const ShapeParticles& particles, std::span<const std::uint32_t> order);
    /// Draws the last upload; may be called repeatedly.
    void draw(const scene::View& view, const gpu::Layer& layer);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t gpuBytes() const;

 private:
    Look look_;
    std::optional<draw::PuffTextures> pictures_;
    std::optional<draw::Billboards> billboards_;
    std::optional<draw::Points> points_;
    std::optional<draw::Lines> lines_;
    std::size_t count_ = 0;
};

}  // namespace dustbench::voxel_shape
