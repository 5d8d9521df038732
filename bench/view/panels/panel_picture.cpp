#include "bench/view/panels/panel_picture.h"

#include <limits>

#include "bench/view/panels/viewer_panels.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/read_back.h"

namespace dustbench::bench {
namespace {

constexpr float fontPixels = 15;
/// ImGui knows the size of a table only after a frame.
constexpr int framesToSettle = 2;
/// The ground truth is drawn when nothing has moved for a frame.
constexpr int framesToRest = 2;

}  // namespace

pictures::Image panelPicture(const ViewState& state, const SplitSettings& split, int width, int height) {
    gpu::Device device;
    Viewer viewer(state, device, "view");
    viewer.paused = true;
    if (state.b) viewer.split = split;
    viewer.split.channel = split.channel;
    viewer.advance(std::numeric_limits<double>::infinity());
    for (int n = 0; n < framesToRest; ++n) viewer.advance();
    if (!viewer.message().empty()) throw InputError("view: " + viewer.message());
    ViewerPanels panels(device, fontPixels);
    const gpu::Texture texture = gpu::Texture::make2D(device, "window", gpu::Format::rgba8, width, height);
    const gpu::Framebuffer target(device, "window", &texture, nullptr);
    for (int n = 0; n < framesToSettle; ++n) panels.draw(viewer, target, width, height, {});
    pictures::Image picture = pictures::decoded(draw::readBack(texture));
    for (glm::vec4& pixel : picture.pixels) pixel.a = 1;
    return picture;
}

}  // namespace dustbench::bench
