// The rays of 4×4 neighbouring pixels, and the section of each that is marched.
//
// Units: cells; positions are relative to the grid's minimum corner. Internal to the CPU march.
#pragma once

#include <cmath>
#include <limits>

#include "methods/kit/raycast/lanes.h"
#include "methods/kit/raycast/pixel_rays.h"

namespace dustbench::raycast {

/// Sections of sixteen rays, as distances from the eye.
struct Stretches {
    Floats from, to;
};

struct RayPacket {
    /// Pixels (x, y) to (x + 3, y + 3).
    RayPacket(const PixelRays& rays, int x, int y) : eye{rays.eye.x, rays.eye.y, rays.eye.z, 0} {
        Floats column, row;
        for (int lane = 0; lane < laneCount; ++lane) {
            const int pixelX = x + lane % 4, pixelY = y + lane / 4;
            column[lane] = static_cast<float>(pixelX) + 0.5f;
            row[lane] = static_cast<float>(pixelY) + 0.5f;
            jitter[lane] = jitterOf(static_cast<std::uint32_t>(pixelX), static_cast<std::uint32_t>(pixelY));
        }
        Floats squares{};
        for (int axis = 0; axis < 3; ++axis) {
            along[axis] = rays.corner[axis] + column * rays.right[axis] + row * rays.up[axis];
            squares += along[axis] * along[axis];
        }
        for (int lane = 0; lane < laneCount; ++lane) stretch[lane] = std::sqrt(squares[lane]);
        for (int axis = 0; axis < 3; ++axis) {
            Floats& a = along[axis];
            a /= stretch;
            const Floats size = a < 0 ? -a : a;
            a = size < 1e-12f ? all(1e-12f) : a;  // finite quotients
            slowest[axis] = minimum(a);
            fastest[axis] = maximum(a);
        }
    }

    /// Section of each ray between two corners; from > to for rays that miss.
    [[nodiscard]] Stretches within(const glm::vec3& low, const glm::vec3& high) const {
        Stretches parts{Floats{}, all(std::numeric_limits<float>::max())};
        for (int axis = 0; axis < 3; ++axis) {
            const Floats a = (low[axis] - eye[axis]) / along[axis], b = (high[axis] - eye[axis]) / along[axis];
            parts.from = atLeast(parts.from, atMost(a, b));
            parts.to = atMost(parts.to, atLeast(a, b));
        }
        return parts;
    }

    /// Corners of the box that contains all rays between two distances.
    [[gnu::always_inline]] [[nodiscard]] Four low(float from, float to) const {
        return eye + atMost(from * slowest, to * slowest);
    }
    [[gnu::always_inline]] [[nodiscard]] Four high(float from, float to) const {
        return eye + atLeast(from * fastest, to * fastest);
    }

    Four eye;
    Floats along[3];            ///< unit directions
    Four slowest{}, fastest{};  ///< minimum and maximum direction, by axis
    Floats stretch;             ///< length of each ray per unit along the camera's axis
    Floats jitter;
};

}  // namespace dustbench::raycast
