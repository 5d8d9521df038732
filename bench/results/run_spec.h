// The full specification of one run: method, world, parameters and how it is measured. Equal specifications have equal
// ids.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/export/volume_settings.h"
#include "bench/reference/judge/judging_plan.h"
#include "bench/world/given_dust.h"
#include "methods/contract/method.h"
#include "methods/contract/parameters.h"

namespace dustbench::results {

/// When to wait for the GPU: every frame, every stage, or only while two frames are in flight.
enum class Sync { frame, stage, none };
inline constexpr Choices<Sync> syncs{{"frame", Sync::frame}, {"stage", Sync::stage}, {"none", Sync::none}};

/// Where the shared dust is simulated; `automatic`: on the GPU if it is hardware and has shaders for all of the dust's
/// parts.
enum class DustOn { cpu, gpu, automatic };
inline constexpr Choices<DustOn> dustPlaces{{"cpu", DustOn::cpu}, {"gpu", DustOn::gpu}, {"auto", DustOn::automatic}};

struct ImageSize {
    int width = 640;
    int height = 480;
    friend bool operator==(const ImageSize&, const ImageSize&) = default;
};
/// `640x480`. Throws InputError.
[[nodiscard]] ImageSize parseSize(std::string_view text);

using ParameterTexts = std::map<std::string, std::string, std::less<>>;

struct RunSpec {
    std::string method;
    std::string scene = "plain";
    std::string drive;        ///< empty: the scene's own
    std::string cameraPath;   ///< file or rows (cameras.h); empty: the camera of the parameter `camera`
    std::string dust;         ///< particles from a file (dust_files.h) instead of the scene's; empty: the scene's
    std::string dustColumns;  ///< the meaning of its columns (dust_moment.h); empty: by name
    DustOn dustOn = DustOn::automatic;
    ParameterTexts parameters;  ///< all parameters of world and method, in canonical form
    std::int64_t frames = 120;
    std::int64_t warmup = 10;
    ImageSize size;
    std::uint64_t seed = 1;
    int threads = 0;  ///< 0: one per core
    Sync sync = Sync::frame;
    std::int64_t imagesEvery = 0;                     ///< 0: no images
    std::optional<exports::VolumeSettings> volumes;   ///< volume export; empty: none
    std::optional<reference::MetricPlan> metricPlan;  ///< frames that get metrics; empty: none
    int repetition = 1;                               ///< counts from 1
    bool timed = true;                                ///< false: runs may overlap, and no times are kept
};

/// Throws InputError if a volume or metric is requested for a frame that the run does not record.
void requireFramesWithinRun(const RunSpec& spec);
/// True for the default of a parameter of the world that was added after results had been kept. Run ids leave it out,
/// so that they still name those results.
[[nodiscard]] bool isLaterDefault(std::string_view name, std::string_view value);
/// The dust for World::useDust.
[[nodiscard]] world::GivenDust givenDust(const RunSpec& spec);
/// Throws InputError if a parameter changes after the last frame.
void requireChangesWithinRun(const RunSpec& spec);

/// A specification's parameter values, split into the world's and the method's.
struct ResolvedParameters {
    ParameterValues world;
    ParameterValues method;
};

/// Splits `given`; missing parameters get their defaults. Throws InputError for an unknown name (with the nearest name
/// of both sets) or an invalid value.
[[nodiscard]] ResolvedParameters resolveParameters(const MethodInfo& method, const ParameterTexts& given);

/// Fills in all defaults and converts every value to canonical form.
[[nodiscard]] ParameterTexts canonicalParameters(const MethodInfo& method, const ParameterTexts& given);

/// Everything that distinguishes runs, one `name=value` per line in a fixed order.
[[nodiscard]] std::string canonicalKey(const RunSpec& spec);

/// What determines the state at a frame, one `name=value` each: the world and all parameters, not how it is measured.
[[nodiscard]] std::vector<std::string> configurationOf(const RunSpec& spec);

/// `billboard-plain-r1-0f3a9b5c2d1e`: a readable prefix and the first 12 digits of the key's SHA-256.
[[nodiscard]] std::string runId(const RunSpec& spec);

}  // namespace dustbench::results
