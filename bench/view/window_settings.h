// What the window remembers from one start to the next: how it looks, and nothing of what it shows.
//
// A file in the user's configuration folder, written whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "bench/results/run_spec.h"
#include "bench/view/split_view.h"

namespace dustbench::bench {

inline constexpr double minimumTextScale = 0.5, maximumTextScale = 4;

struct WindowSettings {
    double textScale = 1;       ///< beyond the display's own
    ImageSize size{1280, 720};  ///< of the window, in the display's units
    Shown shown = Shown::wipe;
    float divider = 0.5f;
    bool showsPanels = true;
    bool keepsPace = true;  ///< the halves are drawn smaller where 15 frames per second need it

    friend bool operator==(const WindowSettings&, const WindowSettings&) = default;
};

/// `dustbench/view.toml` in $XDG_CONFIG_HOME, else in ~/.config; empty if neither is known. As the XDG Base Directory
/// Specification has it, a relative $XDG_CONFIG_HOME counts as none.
[[nodiscard]] std::filesystem::path windowSettingsFile();

[[nodiscard]] std::string toToml(const WindowSettings& settings);

/// Keeps the settings in a file: reads them, and writes what has changed.
class SettingsKeeper {
 public:
    /// So many calls of `keep` with the same settings until they are written, so that a drag is written once.
    static constexpr int callsToSettle = 60;

    /// Reads `file`; an empty name keeps nothing. No file is no error.
    explicit SettingsKeeper(std::filesystem::path file);

    /// As they were read: the defaults where there is no file, or where it cannot be read.
    [[nodiscard]] const WindowSettings& read() const { return read_; }
    /// One line: why the file cannot be read, which then stays as it is, or which unknown key in it is ignored. Empty
    /// if all is well.
    [[nodiscard]] const std::string& problem() const { return problem_; }

    /// Once a frame. Throws InputError if they cannot be written, once for each change.
    void keep(const WindowSettings& now);
    /// At the end: writes what is not written yet. Throws InputError.
    void finish();

 private:
    [[nodiscard]] WindowSettings parse();

    std::filesystem::path file_;
    bool isReadable_ = true;
    std::string problem_;
    WindowSettings read_, written_, now_;
    int calls_ = 0;  ///< with the settings `now_`
};

}  // namespace dustbench::bench
