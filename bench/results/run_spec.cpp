#include "bench/results/run_spec.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "bench/measure/sha256.h"
#include "bench/world/time_step.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::results {
namespace {

constexpr int largestEdge = 16384;

/// The letters, digits, '_' and '-' in the stem of a scene's name or file name.
std::string plainName(std::string_view name) {
    std::string plain;
    for (const char letter : std::filesystem::path(name).stem().string())
        if (std::isalnum(static_cast<unsigned char>(letter)) || letter == '_' || letter == '-') plain.push_back(letter);
    return plain.substr(0, 40);
}

/// The message gives the memory that so many particles need, which is the reason for the limit.
void requireFewEnough(const std::string& text) {
    const Parameter& declared = *world::worldParameters().find("particles");
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (end != text.data() + text.size() || error != std::errc() || static_cast<double>(count) <= declared.maximum)
        return;
    const double bytes = static_cast<double>(particles::ParticleStore::bytesPerParticle);
    throw InputError(fmt::format(
        "parameter particles: got '{}', which alone need {:.3g} GB of memory, allowed: integer 0..{:.0f} ({:.3g} GB)",
        text, static_cast<double>(count) * bytes / 1e9, declared.maximum, declared.maximum * bytes / 1e9));
}

}  // namespace

ImageSize parseSize(std::string_view text) {
    ImageSize size{0, 0};
    const char* const end = text.data() + text.size();
    const auto [middle, widthError] = std::from_chars(text.data(), end, size.width);
    if (widthError == std::errc() && middle != end && *middle == 'x') {
        const auto [last, heightError] = std::from_chars(middle + 1, end, size.height);
        if (heightError == std::errc() && last == end && size.width >= 1 && size.height >= 1 &&
            size.width <= largestEdge && size.height <= largestEdge)
            return size;
    }
    throw InputError(fmt::format("size: got '{}', allowed: WIDTHxHEIGHT with edges 1..{}", text, largestEdge));
}

ResolvedParameters resolveParameters(const MethodInfo& method, const ParameterTexts& given) {
    ResolvedParameters resolved{ParameterValues(world::worldParameters()), ParameterValues(method.parameters)};
    for (const auto& [name, text] : given) {
        if (method.parameters.find(name)) {
            resolved.method.set(name, text);
        } else if (world::worldParameters().find(name)) {
            if (name == "particles") requireFewEnough(text);
            resolved.world.set(name, text);
        } else {
            std::vector<std::string> known;
            for (const ParameterSet* set : {&method.parameters, &world::worldParameters()})
                for (const Parameter& parameter : set->all()) known.push_back(parameter.name);
            throw unknownName("parameter of " + method.id, name, known);
        }
    }
    return resolved;
}

ParameterTexts canonicalParameters(const MethodInfo& method, const ParameterTexts& given) {
    const ResolvedParameters resolved = resolveParameters(method, given);
    ParameterTexts all = resolved.world.canonical();
    for (const auto& [name, text] : resolved.method.canonical()) all[name] = text;
    return all;
}

void requireChangesWithinRun(const RunSpec& spec) {
    const MethodInfo& method = findMethod(spec.method);
    const auto isChanges = [](const Parameter& parameter) { return parameter.type == ParameterType::changes; };
    if (std::ranges::none_of(method.parameters.all(), isChanges)) return;
    const ParameterValues values = resolveParameters(method, spec.parameters).method;
    const double last = static_cast<double>(spec.frames - 1) * world::stepSeconds;
    for (const Parameter& parameter : values.declared().all()) {
        if (parameter.type != ParameterType::changes) continue;
        for (const Change& change : values.changes(parameter.name))
            if (change.seconds > last)
                throw InputError(
                    fmt::format("parameter {}: {}={} at {} s is after the last frame, allowed: 0..{:.6g} s "
                                "(--frames {})",
                                parameter.name, change.name, change.value, change.seconds, last, spec.frames));
    }
}

void requireFramesWithinRun(const RunSpec& spec) {
    if (spec.metricPlan) reference::requireMomentsWithinRun(*spec.metricPlan, spec.frames);
    if (!spec.volumes || spec.volumes->frames.last < spec.frames) return;
    throw InputError(fmt::format("volumes: frame {} is beyond the run's end, allowed: frames 0..{} (--frames {})",
                                 spec.volumes->frames.last, spec.frames - 1, spec.frames));
}

bool isLaterDefault(std::string_view name, std::string_view value) {
    return name == "puffs_per_metre" && value == "0";
}

world::GivenDust givenDust(const RunSpec& spec) {
    return {spec.dust, spec.dustColumns, spec.warmup, spec.frames};
}

std::string canonicalKey(const RunSpec& spec) {
    std::string key = fmt::format("method={}\nscene={}\ndrive={}\n", spec.method, spec.scene, spec.drive);
    if (!spec.cameraPath.empty()) key += fmt::format("camera_path={}\n", spec.cameraPath);
    if (!spec.dust.empty()) key += fmt::format("dust={}\ndust_columns={}\n", spec.dust, spec.dustColumns);
    if (spec.dustOn != DustOn::automatic) key += fmt::format("dust_on={}\n", dustPlaces.wordOf(spec.dustOn));
    for (const auto& [name, text] : spec.parameters)
        if (!isLaterDefault(name, text)) key += fmt::format("p.{}={}\n", name, text);
    key += fmt::format("frames={}\nwarmup={}\nsize={}x{}\nseed={}\nthreads={}\nsync={}\nimages={}\nrepetition={}\n",
                       spec.frames, spec.warmup, spec.size.width, spec.size.height, spec.seed, spec.threads,
                       syncs.wordOf(spec.sync), spec.imagesEvery, spec.repetition);
    if (!spec.timed) key += "times=0\n";
    if (spec.volumes) {
        const exports::VolumeSettings& volumes = *spec.volumes;
        key += fmt::format("volumes={}\nformats={}\nresolution={}\nregion={}\n", volumes.frames.text(),
                           exports::formatsText(volumes.formats), volumes.resolution,
                           volumes.region ? exports::regionText(*volumes.region) : "");
        for (const auto& [id, word] : volumes.namedOptions()) key += fmt::format("{}={}\n", id, word);
    }
    if (spec.metricPlan)
        key += fmt::format("metrics={}\nmetric_reference={}\n",
                           spec.metricPlan->moments ? spec.metricPlan->moments->text() : "",
                           spec.metricPlan->referenceText());
    if (spec.metricPlan && !spec.metricPlan->keepsPictures) key += "metric_pictures=0\n";
    return key;
}

std::vector<std::string> configurationOf(const RunSpec& spec) {
    std::vector<std::string> lines{"scene=" + spec.scene};
    const auto addIfAny = [&lines](const char* name, const std::string& text) {
        if (!text.empty()) lines.push_back(fmt::format("{}={}", name, text));
    };
    addIfAny("drive", spec.drive);
    addIfAny("camera_path", spec.cameraPath);
    addIfAny("dust", spec.dust);
    addIfAny("dust_columns", spec.dustColumns);
    lines.push_back(fmt::format("seed={}", spec.seed));
    lines.push_back(fmt::format("warmup={}", spec.warmup));
    for (const auto& [name, text] : spec.parameters) lines.push_back(fmt::format("{}={}", name, text));
    return lines;
}

std::string runId(const RunSpec& spec) {
    const std::string drive = spec.drive.empty() ? "" : fmt::format("-{}", plainName(spec.drive));
    return fmt::format("{}-{}{}-r{}-{}", spec.method, plainName(spec.scene), drive, spec.repetition,
                       measure::sha256(canonicalKey(spec)).substr(0, 12));
}

}  // namespace dustbench::results
