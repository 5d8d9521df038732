// The state of the window as a value and as text: a `dustbench run` line for each half, or TOML.
//
// A half shows the picture that the run of its line saves for the last frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/results/run_spec.h"

namespace dustbench::view {

enum class Half { a, b };

/// As half B's method: the ground truth of the shared dust in half A's scene. No run draws it.
inline constexpr const char* exactPicture = "exact";
/// The method that draws the ground truth to within 1e-5 while things move, if this build has it.
inline constexpr const char* groundTruthMethod = "exact_tiles";

/// A method and the parameters that are set; the others have their defaults.
struct HalfState {
    std::string method;  ///< or exactPicture
    results::ParameterTexts parameters;

    friend bool operator==(const HalfState&, const HalfState&) = default;
};

struct ViewState {
    std::string scene = "plain";
    std::string drive;       ///< a name, a file or keyboardDrive; empty: the scene's own
    std::string cameraPath;  ///< file or rows (cameras.h); empty: the camera of the world's parameters
    std::string dust;        ///< file of particles; empty: the scene's dust
    std::string dustColumns;
    results::ParameterTexts world;  ///< parameters of the world that are set
    std::uint64_t seed = 1;
    results::ImageSize size;
    int threads = 0;          ///< 0: one per core
    std::int64_t warmup = 0;  ///< number of frames before frame 0, as in a run
    std::int64_t frame = 0;
    HalfState a;
    std::optional<HalfState> b;

    friend bool operator==(const ViewState&, const ViewState&) = default;
};

/// As the drive: the vehicle is driven live. A run cannot do that; it can replay a saved recording.
inline constexpr const char* keyboardDrive = "keyboard";

[[nodiscard]] const HalfState& half(const ViewState& state, Half half);
/// Half B is the ground truth.
[[nodiscard]] bool showsExact(const ViewState& state);

/// The run that ends with the half's picture. Throws InputError for an unknown name or an invalid value, and for
/// keyboardDrive and exactPicture.
[[nodiscard]] results::RunSpec runOf(const ViewState& state, Half half);

/// Removes parameters that equal their defaults, with presets considered, and writes values in canonical form, so that
/// equivalent states are equal. Throws InputError for an unknown name or an invalid value.
[[nodiscard]] ViewState normalised(const ViewState& state);

/// `dustbench run … --out OUT`, quoted for a shell. Throws InputError as runOf does, and for a value that the command
/// line would read as several values.
[[nodiscard]] std::string commandLine(const ViewState& state, Half half, const std::string& out);

/// Reads the state from a `dustbench run` line, without half B. Options that do not change the picture are ignored.
/// Throws InputError for anything that `run` would not accept, or that means several runs.
[[nodiscard]] ViewState stateOfCommandLine(std::string_view line);

[[nodiscard]] std::string toToml(const ViewState& state);
/// `name` is the file in messages. Throws InputError with file, line and the expected content.
[[nodiscard]] ViewState stateOfToml(std::string_view text, const std::string& name);

}  // namespace dustbench::view
