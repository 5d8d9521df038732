#include "bench/view/moment_maps.h"

#include <algorithm>
#include <cmath>

#include "bench/export/collected_volume.h"
#include "bench/measure/clock.h"
#include "bench/measure/image/flip.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/image_check.h"
#include "bench/measure/image/quads_per_pixel.h"
#include "bench/reference/judge/moment_pictures.h"
#include "bench/view/image_upload.h"
#include "bench/view/outlines.h"
#include "methods/kit/draw/read_back.h"

namespace dustbench::bench {
namespace {

Measured flipOf(const ViewSession& session) {
    if (session.isExact(Half::b) && session.isEvaluated() && session.exact().whyNotEvaluated().empty()) {
        const EvaluatedMoment& evaluated = session.exact().evaluated();
        return {evaluated.metrics.values.of("flip"), evaluated.difference};
    }
    return flip(preparePicture(session.image(Half::b), "the picture of B"),
                preparePicture(session.image(Half::a), "the picture of A"));
}

bool isFinite(const glm::vec4& value) {
    return std::isfinite(value.r) && std::isfinite(value.g) && std::isfinite(value.b) && std::isfinite(value.a);
}

}  // namespace

LayerFaults faultsOf(const pictures::Image& layer) {
    LayerFaults faults;
    for (std::size_t i = 0; i < layer.pixels.size(); ++i) {
        const glm::vec4& pixel = layer.pixels[i];
        if (!isFinite(pixel))
            ++faults.notFinite;
        else if (pixel.r < 0 || pixel.g < 0 || pixel.b < 0)
            ++faults.negative;
        else if (pixel.a < -alphaTolerance || pixel.a > 1 + alphaTolerance)
            ++faults.alpha;
        else
            continue;
        const int index = static_cast<int>(i);
        if (!faults.first) faults.first = glm::ivec2(index % layer.width, index / layer.width);
    }
    return faults;
}

void MomentMaps::fit(gpu::Texture& texture, const char* label, const ViewSession& session) {
    const ImageSize size = session.state().size;
    if (texture.width() != size.width || texture.height() != size.height)
        texture = gpu::Texture::make2D(device_, label, gpu::Format::rgba8, size.width, size.height);
}

const gpu::Texture& MomentMaps::flip(const ViewSession& session) {
    if (flipMoment_ != session.drawnMoment()) makeFlip(session);
    return flip_;
}

void MomentMaps::makeFlip(const ViewSession& session) {
    const std::int64_t start = steadyNow();
    const Measured measured = flipOf(session);
    fit(flip_, "FLIP", session);
    upload(heatMap(measured.map), flip_);
    flipMean_ = measured.value;
    flipSeconds_ = static_cast<double>(steadyNow() - start) / 1e9;
    flipMoment_ = session.drawnMoment();
}

const gpu::Texture& MomentMaps::overdraw(ViewSession& session, Half half) {
    if (overdrawMoment_ != session.drawnMoment()) makeOverdraw(session);
    return overdraw_.at(half == Half::a ? 0 : 1);
}

void MomentMaps::makeOverdraw(ViewSession& session) {
    const ImageSize size = session.state().size;
    std::array<Plane, 2> maps;
    float maximum = 1;
    for (const Half half : {Half::a, Half::b}) {
        Plane& map = maps.at(half == Half::a ? 0 : 1);
        map = Plane(size.width, size.height);
        if (!session.hasHost(half)) continue;
        CollectedVolume volume;
        session.volume(half, volume);
        map = overdrawMap(primitivesOnScreen(volume, session.view()), size.width, size.height);
        maximum = std::max(maximum, std::ranges::max(map.values));
    }
    for (std::size_t i = 0; i < maps.size(); ++i) {
        fit(overdraw_[i], "overdraw", session);
        upload(heatMap(maps[i], 0, maximum), overdraw_[i]);
    }
    overdrawLimit_ = static_cast<double>(maximum);
    overdrawMoment_ = session.drawnMoment();
}

const gpu::Texture& MomentMaps::outlines(ViewSession& session, Half half) {
    const std::size_t index = half == Half::a ? 0 : 1;
    gpu::Texture& texture = outlines_.at(index);
    if (outlinesMoment_.at(index) == session.drawnMoment()) return texture;
    CollectedVolume volume;
    if (session.hasHost(half)) session.volume(half, volume);
    fit(texture, "outlines", session);
    upload(withOutlines(session.image(half), outlinesOf(volume, session.view())), texture);
    outlinesMoment_.at(index) = session.drawnMoment();
    return texture;
}

const LayerFaults& MomentMaps::faults(const ViewSession& session, Half half) {
    const std::size_t index = half == Half::a ? 0 : 1;
    if (faultsMoment_.at(index) != session.drawnMoment()) {
        faults_.at(index) = faultsOf(draw::readBack(session.textures(half).layer));
        faultsMoment_.at(index) = session.drawnMoment();
    }
    return faults_.at(index);
}

}  // namespace dustbench::bench
