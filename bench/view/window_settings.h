// Settings that the window keeps between starts: its appearance, not the scene or the methods.
//
// Stored in a file in the user's configuration folder, which is written completely or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "bench/results/run_spec.h"
#include "bench/view/split_view.h"

namespace dustbench::view {

inline constexpr double minimumTextScale = 0.5, maximumTextScale = 4;

struct WindowSettings {
    double textScale = 1;                ///< in addition to the display's scale
    results::ImageSize size{1280, 720};  ///< of the window, in the display's units
    Shown shown = Shown::wipe;
    float divider = 0.5f;
    bool showsPanels = true;
    bool keepsPace = true;  ///< draw the halves smaller if 15 frames per second require it

    friend bool operator==(const WindowSettings&, const WindowSettings&) = default;
};

/// `dustbench/view.toml` in $XDG_CONFIG_HOME, otherwise in ~/.config; empty if neither is known. A relative
/// $XDG_CONFIG_HOME is ignored, as the XDG Base Directory Specification requires.
[[nodiscard]] std::filesystem::path windowSettingsFile();

[[nodiscard]] std::string toToml(const WindowSettings& settings);

/// Keeps the settings in a file: reads them, and writes changes.
class SettingsKeeper {
 public:
    /// Number of calls of `keep` with the same settings before they are written, so that a drag is written once.
    static constexpr int callsToSettle = 60;

    /// Reads `file`. With an empty name, nothing is read or written. A missing file is not an error.
    explicit SettingsKeeper(std::filesystem::path file);

    /// The settings that were read; the defaults if there is no file or it cannot be read.
    [[nodiscard]] const WindowSettings& read() const { return read_; }
    /// One line: why the file cannot be read, which is then left unchanged, or which unknown key is ignored. Empty if
    /// there is no problem.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// Call once a frame. Throws InputError if they cannot be written, once for each change.
    void keep(const WindowSettings& now);
    /// Call at the end: writes pending changes. Throws InputError.
    void finish();

 private:
    [[nodiscard]] WindowSettings parse();

    std::filesystem::path file_;
    bool isReadable_ = true;
    std::string problem_;
    WindowSettings read_, written_, now_;
    int calls_ = 0;  ///< number of calls with the settings `now_`
};

}  // namespace dustbench::view
