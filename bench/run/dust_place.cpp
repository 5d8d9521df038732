#include "bench/run/dust_place.h"

#include <fmt/format.h>

#include "bench/run/method_host.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {

void requireDustPlace(const RunSpec& spec, const World& world) {
    if (spec.dustOn != DustOn::gpu) return;
    if (const std::string why = world.whyDustStaysOnCpu(); !why.empty())
        throw InputError(fmt::format("dust_on: got gpu, but {} has no shader, allowed: cpu|auto", why));
}

DustPlace placeDust(const RunSpec& spec, World& world, gpu::Device& device) {
    requireDustPlace(spec, world);
    const DustPlace requested{std::string(dustPlaces.wordOf(spec.dustOn)), "requested"};
    if (spec.dustOn == DustOn::cpu) return requested;
    if (spec.dustOn == DustOn::automatic) {
        if (device.isSoftware()) return {"cpu", "software device"};
        if (const std::string why = world.whyDustStaysOnCpu(); !why.empty()) return {"cpu", why + " has no shader"};
    }
    world.moveDustTo(device);
    return spec.dustOn == DustOn::gpu ? requested : DustPlace{"gpu", "hardware device"};
}

std::string readBackWarning(const World& world, const MethodInfo& info, const ParameterValues& parameters) {
    if (!world.gpuDust() || takesGpuDust(info, parameters)) return {};
    return fmt::format(
        "dust_on=gpu: the method {} takes no GPU buffers with these parameters, so each frame reads the dust back, "
        "which the stage 'upload' contains",
        info.id);
}

}  // namespace dustbench::bench
