#include "methods/plugin_particles/shape_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/layer_blend.h"
#include "methods/kit/draw/mesh_instances.h"
#include "methods/kit/draw/points.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/kit/particles/lattice.h"
#include "methods/plugin_particles/curve_pass.h"

namespace dustbench::plugin_particles {
namespace {

// --- Points, lines, and both together.

bool isAdditive(const particles::Look& look) {
    return look.blending == particles::Blending::additive;
}

class PointPass final : public ShapePass {
 public:
    PointPass(gpu::Device& device, const particles::Look& look)
        : points_(device, {.sprite = look.round, .pixels = look.pixels, .additive = isAdditive(look)}) {}

    void upload(const Drawn& drawn) override {
        constexpr std::size_t floats = 8;
        const Puffs& p = drawn.puffs;
        fill(points_.map(p.size(), draw::Points::layout()), floats, drawn, [&](float* value, std::size_t i) {
            const glm::vec3 colour = p.colour(i);
            value[0] = p.x[i], value[1] = p.y[i], value[2] = p.z[i];
            value[3] = p.radius[i], value[4] = p.opacity[i];
            value[5] = colour.r, value[6] = colour.g, value[7] = colour.b;
        });
        points_.unmap();
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override { points_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return points_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return points_.gpuBytes(); }

 private:
    draw::Points points_;
};

class LinePass final : public ShapePass {
 public:
    LinePass(gpu::Device& device, const particles::Look& look)
        : seconds_(look.seconds), lines_(device, {.seconds = 1, .additive = isAdditive(look), .fade = look.fading}) {}

    void upload(const Drawn& drawn) override {
        constexpr std::size_t floats = 10;
        const Puffs& p = drawn.puffs;
        fill(lines_.map(p.size(), draw::Lines::layout()), floats, drawn, [&](float* value, std::size_t i) {
            const glm::vec3 colour = p.colour(i), way = drawn.wayOf(i, seconds_);
            value[0] = p.x[i], value[1] = p.y[i], value[2] = p.z[i];
            value[3] = way.x, value[4] = way.y, value[5] = way.z;
            value[6] = p.opacity[i];
            value[7] = colour.r, value[8] = colour.g, value[9] = colour.b;
        });
        lines_.unmap();
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override { lines_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return lines_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return lines_.gpuBytes(); }

 private:
    float seconds_;
    draw::Lines lines_;
};

class HybridPass final : public ShapePass {
 public:
    HybridPass(gpu::Device& device, const particles::Look& look) : lines_(device, look), points_(device, look) {}

    void upload(const Drawn& drawn) override {
        lines_.upload(drawn);
        points_.upload(drawn);
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override {
        lines_.draw(view, layer);
        points_.draw(view, layer);
    }
    [[nodiscard]] std::size_t count() const override { return lines_.count() + points_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return lines_.gpuBytes() + points_.gpuBytes(); }

 private:
    LinePass lines_;
    PointPass points_;
};

// --- Puffs and sprites.

using particles::AntiAliasing;
using particles::Look;
using particles::Primitive;

std::optional<draw::PuffTextures> picturesOf(gpu::Device& device, const Look& look) {
    if (look.picture.empty()) return std::nullopt;
    return draw::PuffTextures(
        device, files::findData("puff picture", "textures", look.picture, ".png"),
        look.framesPerSecond > 0 ? draw::PuffTextures::Frames::looped : draw::PuffTextures::Frames::separate);
}

draw::BillboardStyle styleOf(const Look& look) {
    return {.facing = look.primitive == Primitive::puff ? draw::Facing::viewpoint : draw::Facing::viewplane,
            .additive = look.blending == particles::Blending::additive,
            .moving = look.primitive == Primitive::movingSprites};
}

/// Puffs and sprites, and sprites that are blurred along their path. Copy k of n is at (k + 1)/n of the path. It has
/// the weight w_k = 2(k + 1)/(n(n + 1)) if the sprite fades in, otherwise 1/n: together the copies have the optical
/// depth, or the light, of one sprite.
class SpritePass final : public ShapePass {
 public:
    SpritePass(gpu::Device& device, const Look& look)
        : look_(look),
          pictures_(picturesOf(device, look)),
          billboards_(device, styleOf(look), pictures_ ? &*pictures_ : nullptr),
          moment_(device),
          mean_(device) {
        if (look.by == AntiAliasing::accumulation) blend_.emplace(device);
    }

    void upload(const Drawn& drawn) override;
    void gather(const GpuPuffs& puffs, const gpu::Buffer* order) override {
        colourOfAll_ = puffs.colourOfAll;
        billboards_.gather(puffs, order);
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override;
    [[nodiscard]] std::size_t count() const override {
        return billboards_.count() * static_cast<std::size_t>(look_.copies);
    }
    [[nodiscard]] std::size_t gpuBytes() const override {
        return billboards_.gpuBytes() + moment_.gpuBytes() + mean_.gpuBytes() +
               (pictures_ ? pictures_->texture().bytes() : 0);
    }

 private:
    [[nodiscard]] float backOf(int copy) const {
        return 1 - static_cast<float>(copy + 1) / static_cast<float>(look_.copies);
    }
    [[nodiscard]] float shareOf(int copy) const {
        const auto n = static_cast<float>(look_.copies);
        return look_.fading ? 2 * static_cast<float>(copy + 1) / (n * (n + 1)) : 1 / n;
    }
    [[nodiscard]] float frameOf(const Puffs& puffs, std::size_t i) const;
    void drawMean(const scene::View& view, const gpu::Layer& layer);

    Look look_;
    std::optional<draw::PuffTextures> pictures_;
    draw::Billboards billboards_;
    draw::OwnLayer moment_, mean_;
    std::optional<draw::LayerBlend> blend_;
    glm::vec3 colourOfAll_{1};
};

/// The picture that sprite `i` shows. A video has a fraction, and begins elsewhere for each sprite: multiples of the
/// golden ratio are far apart.
float SpritePass::frameOf(const Puffs& puffs, std::size_t i) const {
    const auto frames = static_cast<std::uint64_t>(pictures_->frames());
    if (look_.framesPerSecond == 0) return static_cast<float>(puffs.serial[i] % frames);
    const auto all = static_cast<double>(frames);
    const double begin = std::fmod(static_cast<double>(puffs.serial[i]) / std::numbers::phi, 1.0) * all;
    const double played = static_cast<double>(puffs.age[i]) * static_cast<double>(look_.framesPerSecond);
    return static_cast<float>(std::fmod(begin + played, all));
}

void SpritePass::upload(const Drawn& drawn) {
    const Puffs& p = drawn.puffs;
    colourOfAll_ = p.colourOfAll;
    const draw::InstanceLayout layout = billboards_.layout(!p.uniformColour);
    const bool moving = look_.primitive == Primitive::movingSprites;
    fill(billboards_.map(p.size(), layout), layout.floats, drawn, [&](float* value, std::size_t i) {
        for (const float next : {p.x[i], p.y[i], p.z[i], p.radius[i], p.opacity[i]}) *value++ = next;
        if (pictures_) *value++ = frameOf(p, i);
        if (moving) {
            const glm::vec3 way = drawn.wayOf(i, look_.seconds);
            for (const float next : {way.x, way.y, way.z}) *value++ = next;
        }
        if (layout.coloured)
            for (const float next : {p.red[i], p.green[i], p.blue[i]}) *value++ = next;
    });
    billboards_.unmap();
}

void SpritePass::draw(const scene::View& view, const gpu::Layer& layer) {
    if (look_.primitive != Primitive::movingSprites) return billboards_.draw(view, colourOfAll_, layer);
    if (blend_) return drawMean(view, layer);
    for (int copy = 0; copy < look_.copies; ++copy)
        billboards_.drawCopy(view, colourOfAll_, layer, {backOf(copy), shareOf(copy)});
}

/// Draws the mean of the pictures of all copies.
void SpritePass::drawMean(const scene::View& view, const gpu::Layer& layer) {
    const bool clamped = look_.blending == particles::Blending::additive && look_.clamped;
    const gpu::Layer& mean = mean_.clearedLike(layer);
    for (int copy = 0; copy < look_.copies; ++copy) {
        const gpu::Layer& moment = moment_.clearedLike(layer);
        billboards_.drawCopy(view, colourOfAll_, moment, {backOf(copy), 1});
        blend_->add(moment.colour(), mean, shareOf(copy), clamped);
    }
    blend_->over(mean.colour(), layer);
}

// --- Meshes: one for each particle, or one whose vertices are the particles.

scene::Mesh meshOf(const particles::Look& look) {
    return meshes::readMesh(files::findData("mesh", "scenes/meshes", look.mesh, ".obj"), glm::vec3(1));
}

/// A mesh for each particle.
class ObjectPass final : public ShapePass {
 public:
    ObjectPass(gpu::Device& device, const particles::Look& look, const scene::Lights& lights)
        : meshes_(device, meshOf(look), lights, look.alongVelocity) {}

    void upload(const Drawn& drawn) override {
        const Puffs& p = drawn.puffs;
        fill(meshes_.map(p.size()), draw::MeshInstances::floats, drawn, [&](float* value, std::size_t i) {
            const glm::vec3 colour = p.colour(i);
            for (const float next : {p.x[i], p.y[i], p.z[i], p.radius[i], p.opacity[i], p.velocityX[i], p.velocityY[i],
                                     p.velocityZ[i], colour.r, colour.g, colour.b})
                *value++ = next;
        });
        meshes_.unmap();
    }
    void draw(const scene::View& view, const gpu::Layer& layer) override { meshes_.draw(view, layer); }
    [[nodiscard]] std::size_t count() const override { return meshes_.count(); }
    [[nodiscard]] std::size_t gpuBytes() const override { return meshes_.gpuBytes(); }

 private:
    draw::MeshInstances meshes_;
};

/// The surface of a lattice of particles as one mesh, made anew from their positions for each picture. It is drawn by
/// the pass for meshes in place of particles, with one instance that leaves it where it is.
class SurfacePass final : public ShapePass {
 public:
    SurfacePass(gpu::Device& device, const particles::Look& look, const scene::Lights& lights)
        : device_(device), look_(look), lights_(lights) {}

    void upload(const Drawn& drawn) override;
    void draw(const scene::View& view, const gpu::Layer& layer) override {
        if (mesh_) mesh_->draw(view, layer);
    }
    [[nodiscard]] std::size_t count() const override { return shape_.indices.size() / 3; }
    [[nodiscard]] std::size_t gpuBytes() const override { return mesh_ ? mesh_->gpuBytes() : 0; }
    [[nodiscard]] std::size_t cpuBytes() const override {
        return surface_.bytes() + 3 * shape_.positions.capacity() * sizeof(glm::vec3) +
               shape_.indices.capacity() * sizeof(std::uint32_t);
    }

 private:
    using Vertex = particles::LatticeSurface::Vertex;

    [[nodiscard]] float brightnessOf(const Vertex& vertex) const {
        if (look_.squares == 0) return 1;
        const glm::ivec2 square = vertex.node / look_.squares;
        return (square.x + square.y) % 2 == 0 ? 1 : look_.darkShare;
    }
    void shape(const Puffs& puffs);

    gpu::Device& device_;
    particles::Look look_;
    scene::Lights lights_;
    particles::LatticeSurface surface_;
    scene::Mesh shape_;
    std::optional<draw::MeshInstances> mesh_;
};

void SurfacePass::shape(const Puffs& puffs) {
    const auto vertices = surface_.vertices();
    for (auto* column : {&shape_.positions, &shape_.normals, &shape_.colours}) column->resize(vertices.size());
    parallel::forEachBlock(vertices.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            const Vertex& v = vertices[k];
            shape_.positions[k] = puffs.position(v.particle);
            shape_.normals[k] = particles::LatticeSurface::normalOf(v, [&](auto i) { return puffs.position(i); });
            shape_.colours[k] = brightnessOf(v) * puffs.colour(v.particle);
        }
    });
}

void SurfacePass::upload(const Drawn& drawn) {
    const Puffs& puffs = drawn.puffs;
    const bool changed = surface_.follow(look_.lattice, puffs.serial);
    shape(puffs);
    if (changed) {
        shape_.indices.assign(surface_.triangles().begin(), surface_.triangles().end());
        mesh_.reset();
        if (!shape_.indices.empty()) mesh_.emplace(device_, shape_, lights_, false);
    }
    if (!mesh_) return;
    mesh_->reshape(shape_);
    const glm::vec3 centre = mesh_->centre();
    const std::span<float> value = mesh_->map(1);
    const std::array<float, draw::MeshInstances::floats> inPlace{
        centre.x, centre.y, centre.z, mesh_->radiusMetres(), puffs.opacity[0], 0, 0, 0, 1, 1, 1};
    std::ranges::copy(inPlace, value.begin());
    mesh_->unmap();
}

}  // namespace

void ShapePass::gather(const GpuPuffs&, const gpu::Buffer*) {
    throw std::logic_error("ShapePass: this look cannot be drawn from GPU buffers");
}

bool drawsFromGpu(const particles::Look& look) {
    return (look.primitive == Primitive::puff || look.primitive == Primitive::sprites) && look.picture.empty();
}

std::unique_ptr<ShapePass> makePass(gpu::Device& device, const particles::Look& look, const scene::Lights& lights) {
    switch (look.primitive) {
        case particles::Primitive::points:
            return std::make_unique<PointPass>(device, look);
        case particles::Primitive::lines:
            return std::make_unique<LinePass>(device, look);
        case particles::Primitive::curves:
            return makeCurvePass(device, look);
        case particles::Primitive::hybrid:
            return std::make_unique<HybridPass>(device, look);
        case particles::Primitive::objects:
            return std::make_unique<ObjectPass>(device, look, lights);
        case particles::Primitive::surface:
            return std::make_unique<SurfacePass>(device, look, lights);
        case particles::Primitive::puff:
        case particles::Primitive::sprites:
        case particles::Primitive::movingSprites:
            break;
    }
    return std::make_unique<SpritePass>(device, look);
}

}  // namespace dustbench::plugin_particles
