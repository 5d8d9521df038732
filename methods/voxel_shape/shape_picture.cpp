#include "methods/voxel_shape/shape_picture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

const ShapeParticles& MergedParticles::of(std::span<LivingShape> shapes) {
    if (shapes.size() == 1) return shapes.front().system().particles();
    std::size_t count = 0;
    for (const LivingShape& shape : shapes) count += shape.system().particles().size();
    all_.resize(count);
    std::size_t first = 0;
    for (const LivingShape& shape : shapes) {
        const ShapeParticles& own = shape.system().particles();
        const auto copy = [&](const auto& from, auto& to) {
            std::ranges::copy(from, to.begin() + static_cast<std::ptrdiff_t>(first));
        };
        using Store = particles::ParticleStore;
        for (const auto column :
             {&Store::x, &Store::y, &Store::z, &Store::velocityX, &Store::velocityY, &Store::velocityZ, &Store::radius,
              &Store::opacity, &Store::red, &Store::green, &Store::blue})
            copy(own.store.*column, all_.store.*column);
        copy(own.picture, all_.picture);
        first += own.size();
    }
    return all_;
}

DrawOrder::DrawOrder(MemoryLedger& ledger)
    : sort_(ledger),
      depths_(ledger.account("draw order")),
      chosenDepths_(ledger.account("draw order")),
      order_(ledger.account("draw order")),
      chosen_(ledger.account("draw order")) {}

std::span<const std::uint32_t> DrawOrder::of(const Look& look, const draw::PointColumns& points, const glm::vec3& eye) {
    switch (look.order) {
        case Order::radix:
            return sort_.farToNear(draw::SortKind::radix, points, eye);
        case Order::quicksort:
            return sort_.farToNear(draw::SortKind::quicksort, points, eye);
        case Order::nearest:
            return nearestSorted(look.nearest, points, eye);
        case Order::every:
            return sortedNowAndThen(look.every, points, eye);
        case Order::none:
            break;
    }
    return sort_.farToNear(draw::SortKind::none, points, eye);
}

std::span<const std::uint32_t> DrawOrder::nearestSorted(std::size_t nearest, const draw::PointColumns& points,
                                                        const glm::vec3& eye) {
    const std::size_t count = points.x.size();
    if (nearest >= count) return sort_.farToNear(draw::SortKind::radix, points, eye);
    depths_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 away = glm::vec3(points.x[i], points.y[i], points.z[i]) - eye;
        depths_[i] = glm::dot(away, away);
    }
    // The squared distance below which points belong to the nearest; points at exactly this distance do not.
    chosenDepths_.assign(depths_.begin(), depths_.end());
    const auto limit = chosenDepths_.begin() + static_cast<std::ptrdiff_t>(nearest);
    std::nth_element(chosenDepths_.begin(), limit, chosenDepths_.end());
    const float beyond = *limit;
    order_.clear();
    chosen_.clear();
    for (std::uint32_t i = 0; i < count; ++i) (depths_[i] < beyond ? chosen_ : order_).push_back(i);
    chosenDepths_.clear();
    for (const std::uint32_t i : chosen_) chosenDepths_.push_back(depths_[i]);
    for (const std::uint32_t k : sort_.farToNear(draw::SortKind::radix, std::span<const float>(chosenDepths_)))
        order_.push_back(chosen_[k]);
    return order_;
}

std::span<const std::uint32_t> DrawOrder::sortedNowAndThen(std::uint32_t every, const draw::PointColumns& points,
                                                           const glm::vec3& eye) {
    const std::size_t count = points.x.size();
    if (calls_++ % std::max(every, 1u) == 0) {
        const auto sorted = sort_.farToNear(draw::SortKind::radix, points, eye);
        order_.assign(sorted.begin(), sorted.end());
        return order_;
    }
    // Removed points leave the order and new ones are appended; a slot that was reused keeps its position.
    const std::size_t before = order_.size();
    if (count < before) {
        std::erase_if(order_, [&](std::uint32_t i) { return i >= count; });
    } else {
        order_.resize(count);
        std::iota(order_.begin() + static_cast<std::ptrdiff_t>(before), order_.end(),
                  static_cast<std::uint32_t>(before));
    }
    return order_;
}

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
