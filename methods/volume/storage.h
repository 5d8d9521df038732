// Interface for storing and showing a volume: as one box of cells (volume.cpp) or as its non-empty bricks
// (sparse/sparse_storage.h).
//
// Units: metres, seconds, extinction per metre. Frame: world. Threads: the OpenGL thread.
#pragma once

#include "methods/contract/method.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volume {

struct VolumeSettings {
    volumes::VolumeSetup setup;
    raycast::RaycastSettings picture;
};

class Storage {
 public:
    virtual ~Storage() = default;

    /// Whether there is a single moment, which never ends.
    [[nodiscard]] virtual bool isStill() const = 0;
    /// Duration from the first moment to the last.
    [[nodiscard]] virtual double seconds() const = 0;

    /// Draws show the volume `seconds` after the first moment from now on.
    virtual void show(double seconds, const StageClock& clock) = 0;
    virtual void draw(const scene::View& view, gpu::Layer& layer) = 0;
    /// Hands over the volume `seconds` after the first moment.
    virtual void handOver(double seconds, VolumeVisitor& visitor) const = 0;
    /// Integral of the extinction over the displayed volume.
    [[nodiscard]] virtual double massSquareMetres() const = 0;
    [[nodiscard]] virtual MemoryReport memory() const = 0;
    /// Number of rays, planes, splats or triangles of the last draw.
    [[nodiscard]] virtual std::int64_t primitives() const = 0;
};

}  // namespace dustbench::volume
