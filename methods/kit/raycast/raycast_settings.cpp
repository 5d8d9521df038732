#include "methods/kit/raycast/raycast_settings.h"

#include <cmath>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::raycast {
namespace {

void checkRange(const char* name, double got, double minimum, double maximum) {
    if (!(got >= minimum && got <= maximum))
        throw InputError(std::string("ray cast: ") + name + ": got " + std::to_string(got) +
                         ", allowed: " + std::to_string(minimum) + ".." + std::to_string(maximum));
}

}  // namespace

void check(const RaycastSettings& settings) {
    if (settings.backend == Backend::cpu && settings.renderer != Renderer::raycast)
        throw InputError("ray cast: got backend cpu, allowed for renderers other than raycast: auto, gl");
    checkRange("step in cells", settings.stepCells, 0.01, 8);
    checkRange("stop alpha", settings.stopAlpha, 0, 1);
    checkRange("shadow cells", settings.shadowCells, 0, 64);
    checkRange("extinction per metre", settings.extinctionPerMetre, 0, 1e6);
    checkRange("density of the isosurface", settings.isoDensity, 1e-6, 1e6);
    for (int channel = 0; channel < 3; ++channel)
        checkRange("smoke colour", static_cast<double>(settings.smokeColour[channel]), 0, 1);
}

float opaqueDepth(const RaycastSettings& settings) {
    return static_cast<float>(-std::log1p(-settings.stopAlpha));
}

}  // namespace dustbench::raycast
