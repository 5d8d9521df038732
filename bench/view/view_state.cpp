#include "bench/view/view_state.h"

#include <fmt/format.h>

#include <stdexcept>

#include "bench/scene/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::bench {
namespace {

/// The smallest part of `given` that results in the same values.
ParameterTexts necessary(const MethodInfo& method, const ParameterTexts& given) {
    const ParameterTexts whole = canonicalParameters(method, given);
    ParameterTexts needed = whole;
    for (const auto& [name, value] : whole) {
        needed.erase(name);
        if (canonicalParameters(method, needed) != whole) needed[name] = value;
    }
    return needed;
}

ParameterTexts merged(const ParameterTexts& world, const ParameterTexts& method) {
    ParameterTexts all = world;
    for (const auto& [name, value] : method) all[name] = value;
    return all;
}

HalfState normalisedHalf(const HalfState& state) {
    if (state.method == exactPicture) {
        if (state.parameters.empty()) return state;
        throw InputError(
            fmt::format("{}: got the parameter '{}', allowed: none", exactPicture, state.parameters.begin()->first));
    }
    const MethodInfo& method = findMethod(state.method);
    HalfState result{method.id, {}};
    for (auto& [name, value] : necessary(method, state.parameters))
        if (method.parameters.find(name)) result.parameters.emplace(name, value);
    return result;
}

}  // namespace

const HalfState& half(const ViewState& state, Half which) {
    if (which == Half::a) return state.a;
    if (!state.b) throw std::logic_error("ViewState: there is no half B");
    return *state.b;
}

bool showsExact(const ViewState& state) {
    return state.b && state.b->method == exactPicture;
}

RunSpec runOf(const ViewState& state, Half which) {
    if (state.drive == keyboardDrive)
        throw InputError("drive: a run cannot be driven by keyboard; save the recording and use its file as the drive");
    const HalfState& shown = half(state, which);
    if (shown.method == exactPicture)
        throw InputError(
            "exact: no run draws the ground truth; `dustbench run --metrics` saves it next to the method's pictures");
    const MethodInfo& method = findMethod(shown.method);
    RunSpec spec;
    spec.method = method.id;
    spec.scene = state.scene;
    spec.drive = state.drive;
    spec.cameraPath = state.cameraPath;
    spec.dust = state.dust;
    spec.dustColumns = state.dustColumns;
    spec.parameters = canonicalParameters(method, merged(state.world, shown.parameters));
    spec.frames = state.frame + 1;
    spec.warmup = state.warmup;
    spec.size = state.size;
    spec.seed = state.seed;
    spec.threads = state.threads;
    spec.imagesEvery = state.frame > 0 ? state.frame : 1;
    return spec;
}

ViewState normalised(const ViewState& state) {
    if (state.a.method == exactPicture)
        throw InputError("half A: got 'exact', allowed: a method; only half B can be the ground truth");
    ViewState result = state;
    result.a = normalisedHalf(state.a);
    if (state.b) result.b = normalisedHalf(*state.b);
    ParameterValues world(worldParameters());
    for (const auto& [name, value] : state.world) world.set(name, value);
    result.world.clear();
    for (const Parameter& parameter : worldParameters().all())
        if (const std::string& value = world.canonical().at(parameter.name); value != parameter.initial)
            result.world[parameter.name] = value;
    return result;
}

}  // namespace dustbench::bench
