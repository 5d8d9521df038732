// The runs of a result that a recommendation may rest on, with what they were measured on.
//
// A run is described by four kinds of settings: its world (scene, drive, size, parameters of the world), those of its
// method, how it was measured (sync, threads, frames), and its seed. Read from a results folder, or a summary.csv
// alone.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

using SettingTexts = std::map<std::string, std::string, std::less<>>;

/// In place of `psnr_mask_db` where the picture equals the reference within the mask and the column is empty.
inline constexpr double identicalDb = std::numeric_limits<double>::infinity();

/// One run that is done and valid.
struct MeasuredRun {
    std::string runId, method, seed;
    SettingTexts world{}, own{}, conduct{};
    std::size_t machine = 0;  ///< of MeasuredRuns::machines
    /// What its pictures were held against: `exact`, or the method with its finer setting; empty if it was not judged.
    std::string reference{};
    std::map<std::string, double, std::less<>> numbers{};  ///< by column of summary.csv; none for an empty cell
};

struct MachineFacts {
    SettingTexts fields;            ///< `cpu`, `cores`, `gl_renderer` …; empty: not known
    std::set<std::string> commits;  ///< of the program
};

struct MeasuredRuns {
    std::string from;  ///< the file or folder, for messages
    std::vector<MeasuredRun> runs{};
    std::vector<MachineFacts> machines{};  ///< one or more
    std::size_t notDone = 0, invalid = 0;
    std::map<std::string, std::size_t> whyInvalid{};  ///< number of runs by reason
};

/// Reads a results folder, a folder with a summary.csv, or such a file; a machine.csv beside it says where it was
/// measured. Throws InputError with the file.
[[nodiscard]] MeasuredRuns readMeasuredRuns(const std::filesystem::path& from);
/// The same of a table alone. Throws InputError with `from` if a column is missing that no table of runs lacks.
[[nodiscard]] MeasuredRuns measuredRuns(const files::CsvTable& table, const std::string& from);

/// One condition: `particles` is 500 or 2000.
struct Condition {
    std::string option;  ///< for messages: `--where`
    std::string key;     ///< `scene`, `size`, `particles` …
    std::vector<std::string> values;
};
/// Keeps the runs that meet every condition; numbers are compared as numbers. Throws InputError for a key that no run
/// has, or values that none of the remaining runs has.
void narrow(MeasuredRuns& runs, const std::vector<Condition>& conditions);

}  // namespace dustbench::bench
