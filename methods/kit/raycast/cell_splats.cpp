#include "methods/kit/raycast/cell_splats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dustbench::raycast {
namespace {

/// Keeps a billboard's opacity below 1, where the optical depth is infinite.
constexpr float maximumOpacity = 0.99999f;

}  // namespace

CellSplats::CellSplats(gpu::Device& device, const RaycastSettings& settings, const Reflected& reflected,
                       MemoryLedger& ledger)
    : settings_(settings),
      reflected_(reflected),
      fire_(settings.fire.table()),
      ledger_(ledger),
      billboards_(std::make_shared<draw::Billboards>(device, draw::BillboardStyle{})),
      sort_(ledger),
      x_(ledger.account("splats")),
      y_(ledger.account("splats")),
      z_(ledger.account("splats")),
      opticalDepth_(ledger.account("splats")),
      colours_(ledger.account("splats")) {}

CellSplats::CellSplats(Beside, const CellSplats& sibling)
    : settings_(sibling.settings_),
      reflected_(sibling.reflected_),
      fire_(sibling.fire_),
      ledger_(sibling.ledger_),
      billboards_(sibling.billboards_),
      first_(false),
      sort_(ledger_),
      x_(ledger_.account("splats")),
      y_(ledger_.account("splats")),
      z_(ledger_.account("splats")),
      opticalDepth_(ledger_.account("splats")),
      colours_(ledger_.account("splats")) {}

std::unique_ptr<GridRenderer> CellSplats::another() const {
    return std::make_unique<CellSplats>(Beside(), *this);
}

void CellSplats::upload(const ShownGrid& grid, const BrickMap&, const LightVolume* light) {
    for (LedgerVector<float>* column : {&x_, &y_, &z_, &opticalDepth_}) column->clear();
    colours_.clear();
    radiusMetres_ = static_cast<float>(grid.spacingMetres * std::sqrt(2 / std::numbers::pi));
    const auto depthOfOne = static_cast<float>(settings_.extinctionPerMetre * grid.spacingMetres);
    const auto lastTexel = static_cast<float>(fire_.size() - 1);
    std::size_t i = 0;
    for (int z = 0; z < grid.cells.z; ++z)
        for (int y = 0; y < grid.cells.y; ++y)
            for (int x = 0; x < grid.cells.x; ++x, ++i) {
                if (grid.density[i] <= 0) continue;
                float depth = grid.density[i] * depthOfOne;
                glm::vec3 colour = reflected_.all();
                if (light) {
                    const glm::ivec3 texel = glm::ivec3(x, y, z) / light->texelCells();
                    const int at = texel.x + light->texels().x * (texel.y + light->texels().y * texel.z);
                    colour = reflected_.ambient + light->values()[static_cast<std::size_t>(at)] * reflected_.sun;
                }
                if (!grid.reaction.empty()) {
                    const float reaction = std::clamp(grid.reaction[i], 0.0f, 1.0f);
                    const glm::vec4& burning = fire_[static_cast<std::size_t>(std::lround(reaction * lastTexel))];
                    depth *= burning.a;
                    colour += glm::vec3(burning);
                }
                const glm::vec3 at(grid.spacingMetres * (glm::dvec3(x, y, z) + 0.5));
                x_.push_back(at.x);
                y_.push_back(at.y);
                z_.push_back(at.z);
                opticalDepth_.push_back(depth);
                if (light || !grid.reaction.empty()) colours_.push_back(colour);
            }
}

std::int64_t CellSplats::draw(const GridPlace& place, const scene::View& view, const gpu::Layer& layer,
                              SceneDepthCopy&) {
    const glm::dvec3 corner = place.grid.originMetres;
    const std::span<const std::uint32_t> order =
        sort_.farToNear(draw::SortKind::radix, {x_, y_, z_}, glm::vec3(view.camera.eye - corner));
    const draw::InstanceLayout layout = billboards_->layout(!colours_.empty());
    float* value = billboards_->map(order.size(), layout).data();
    for (const std::uint32_t i : order) {
        const glm::vec3 at(corner + glm::dvec3(x_[i], y_[i], z_[i]));
        const float opacity = std::min(-std::expm1(-opticalDepth_[i] * place.thickness), maximumOpacity);
        for (const float number : {at.x, at.y, at.z, radiusMetres_, opacity}) *value++ = number;
        if (!layout.coloured) continue;
        for (int channel = 0; channel < 3; ++channel) *value++ = colours_[i][channel];
    }
    billboards_->unmap();
    billboards_->draw(view, reflected_.all(), layer);
    return static_cast<std::int64_t>(x_.size());
}

}  // namespace dustbench::raycast
