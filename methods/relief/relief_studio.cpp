#include "methods/relief/relief_studio.h"

#include <cmath>
#include <numbers>

#include "methods/kit/draw/read_back.h"

namespace dustbench::relief {

ReliefStudio::ReliefStudio(gpu::Device& device, const scene::Scene& scene, const scene::Panel& panel,
                           const ReliefStyle& style, const scene::View& view)
    : panel_(panel),
      view_(view),
      surface_(*panel.relief, ledger_),
      pyramid_(surface_.depths(), ledger_),
      pass_(device, scene, panel, pyramid_, style),
      nothing_(gpu::Texture::make2D(device, "nothing", gpu::Format::depth32F, view.width, view.height)),
      target_(device, view.width, view.height) {
    nothing_.write(std::span<const float>(std::vector<float>(static_cast<std::size_t>(view.width * view.height), 0)));
}

void ReliefStudio::draw() {
    draw(view_);
}

void ReliefStudio::draw(const scene::View& view) {
    const TexelRectangle changed = surface_.takeChanged();
    pyramid_.update(surface_.depths(), changed);
    static_cast<void>(pass_.upload(surface_, pyramid_, changed));
    target_.begin(nothing_);
    pass_.draw(view, panel_.toParent);
}

pictures::Image ReliefStudio::picture() const {
    return draw::readBack(target_.layer().colour());
}

std::vector<float> ReliefStudio::depths() const {
    return target_.layer().sceneDepth().readFloats();
}

scene::View viewOf(const scene::Panel& panel, double degrees, int width, int height) {
    scene::View view;
    view.width = width;
    view.height = height;
    view.camera.verticalFieldOfView = 0.6;
    view.camera.nearMetres = 0.01;
    const double halfWidth = std::tan(view.camera.verticalFieldOfView / 2) * width / height;
    const double away = panel.sizeMetres.x / 2 / halfWidth, angle = degrees * std::numbers::pi / 180;
    const auto inWorld = [&](const glm::dvec3& place) { return glm::dvec3(panel.toParent * glm::dvec4(place, 1)); };
    view.camera.eye = inWorld(away * glm::dvec3(std::sin(angle), 0, std::cos(angle)));
    view.camera.target = inWorld({0, 0, 0});
    view.camera.up = glm::dvec3(panel.toParent[1]);
    return view;
}

}  // namespace dustbench::relief
