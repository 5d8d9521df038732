#include "methods/voxel_shape/shape_picture.h"

#include <cmath>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::voxel_shape {
namespace {

/// Calls `put(value, i)` for each particle `i` of the order; `value` points to the particle's floats in the buffer.
template <typename Put>
void fill(std::span<float> memory, std::size_t floats, std::span<const std::uint32_t> order, const Put& put) {
    parallel::forEachBlock(order.size(), 16'384, [&](std::size_t first, std::size_t count) {
        for (std::size_t place = first; place < first + count; ++place)
            put(memory.data() + place * floats, order[place]);
    });
}

}  // namespace

ShapePicture::ShapePicture(gpu::Device& device, const Look& look) : look_(look) {
    switch (look.render) {
        case Render::points:
        case Render::sprites:
            points_.emplace(device, draw::PointStyle{look.render == Render::sprites, look.pixels, look.additive});
            return;
        case Render::lines:
            lines_.emplace(device, draw::LineStyle{.additive = look.additive});
            return;
        case Render::billboards:
            break;
        case Render::textured:
            pictures_.emplace(device, files::findData("puff picture", "textures", "puffs", ".png"),
                              draw::PuffTextures::Frames::separate);
            break;
        case Render::animated:
            pictures_.emplace(device, files::findData("puff picture", "textures", "puff_animated", ".png"),
                              draw::PuffTextures::Frames::crossFaded);
            break;
    }
    billboards_.emplace(device, draw::BillboardStyle{.soft = !look.additive, .additive = look.additive},
                        pictures_ ? &*pictures_ : nullptr);
}

void ShapePicture::upload(const ShapeParticles& particles, std::span<const std::uint32_t> order) {
    const particles::ParticleStore& s = particles.store;
    count_ = order.size();
    if (points_) {
        fill(points_->map(count_, draw::Points::layout()), draw::Points::layout().floats, order,
             [&](float* value, std::uint32_t i) {
                 for (const float next :
                      {s.x[i], s.y[i], s.z[i], s.radius[i], s.opacity[i], s.red[i], s.green[i], s.blue[i]})
                     *value++ = next;
             });
        points_->unmap();
    } else if (lines_) {
        fill(lines_->map(count_, draw::Lines::layout()), draw::Lines::layout().floats, order,
             [&](float* value, std::uint32_t i) {
                 for (const float next : {s.x[i], s.y[i], s.z[i], s.velocityX[i], s.velocityY[i], s.velocityZ[i],
                                          s.opacity[i], s.red[i], s.green[i], s.blue[i]})
                     *value++ = next;
             });
        lines_->unmap();
    } else {
        const auto layout = billboards_->layout(true);
        const float frames = pictures_ ? static_cast<float>(pictures_->frames()) : 1;
        const bool animated = look_.render == Render::animated;
        fill(billboards_->map(count_, layout), layout.floats, order, [&](float* value, std::uint32_t i) {
            for (const float next : {s.x[i], s.y[i], s.z[i], s.radius[i], s.opacity[i]}) *value++ = next;
            if (billboards_->framed()) {
                // An animation repeats after its last picture; a still image uses one of the pictures throughout.
                const float length = animated ? frames - 1 : frames;
                const float shown = animated ? particles.picture[i] : std::floor(particles.picture[i]);
                *value++ = length > 0 ? shown - std::floor(shown / length) * length : 0.0f;
            }
            for (const float next : {s.red[i], s.green[i], s.blue[i]}) *value++ = next;
        });
        billboards_->unmap();
    }
}

void ShapePicture::draw(const scene::View& view, const gpu::Layer& layer) {
    if (points_) points_->draw(view, layer);
    if (lines_) lines_->draw(view, layer);
    if (billboards_) billboards_->draw(view, glm::vec3(1), layer);
}

std::size_t ShapePicture::gpuBytes() const {
    return (points_ ? points_->gpuBytes() : 0) + (lines_ ? lines_->gpuBytes() : 0) +
           (billboards_ ? billboards_->gpuBytes() : 0) + (pictures_ ? pictures_->texture().bytes() : 0);
}

}  // namespace dustbench::voxel_shape
