#include "methods/kit/draw/depth_mapping.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "draw_shaders.h"

namespace dustbench::draw {

DepthMapping::DepthMapping(gpu::Device& device, gpu::ShaderFile piece, std::map<std::string, std::string> definitions)
    : device_(device),
      piece_(piece),
      definitions_(std::move(definitions)),
      mapping_(device, "depth mapping", sizeof(glm::vec4)) {}  // a uniform block is made of whole vec4s

void DepthMapping::use(const glm::vec2& mapping) {
    mapping_.write(std::span(&mapping, 1));
    mapping_.bindUniform(0);
}

void DepthMapping::useRangeOf(const GpuPuffs& dust, const scene::View& view) {
    if (!passes_) {
        auto ofMapping = definitions_;
        ofMapping["MAPPING"] = "";
        passes_.emplace(Passes{{device_, "depth range", {piece_, draw_shaders::depth_range_comp}, definitions_},
                               {device_, "depth mapping", {piece_, draw_shaders::depth_range_comp}, ofMapping},
                               {device_, "depth range", 2 * sizeof(std::uint32_t)}});
    }
    const std::array<std::uint32_t, 2> nothing{std::bit_cast<std::uint32_t>(std::numeric_limits<float>::max()), 0};
    passes_->ends.write(std::span<const std::uint32_t>(nothing));
    passes_->ends.bindStorage(0);
    const glm::dvec3 eye = view.camera.eye, ahead = glm::normalize(view.camera.target - eye);
    passes_->range.set("eye", glm::vec4(eye, view.camera.nearMetres));
    passes_->range.set("ahead", glm::vec3(ahead));
    passes_->mapping.set("nearMetres", static_cast<float>(view.camera.nearMetres));
    dust.position->bindStorage(1);
    dust.look->bindStorage(2);
    dust.tally->bindStorage(3);
    passes_->range.dispatchIndirect(*dust.tally, sizeof(std::uint32_t));
    mapping_.bindStorage(1);
    passes_->mapping.dispatch(1, 1, 1);
    mapping_.bindUniform(0);
}

}  // namespace dustbench::draw
