// The runs for a recommendation, with the machines on which they were measured.
//
// Four kinds of settings describe a run: its world (scene, drive, size, parameters of the world), the parameters of its
// method, the way of measuring (sync, threads, frames), and its seed. Read from a results folder or from a summary.csv
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

namespace dustbench::recommend {

using SettingTexts = std::map<std::string, std::string, std::less<>>;

/// `psnr_mask_db` of a picture that equals the reference within the mask; the column is empty then.
inline constexpr double identicalDb = std::numeric_limits<double>::infinity();

/// One completed and valid run.
struct MeasuredRun {
    std::string runId, method, seed;
    SettingTexts world{}, own{}, conduct{};
    std::size_t machine = 0;  ///< index in MeasuredRuns::machines
    /// The reference of its pictures: `exact`, or the method with its finer setting; empty if it has no metrics.
    std::string reference{};
    std::map<std::string, double, std::less<>> numbers{};  ///< by column of summary.csv; none for an empty field
};

struct MachineFacts {
    SettingTexts fields;            ///< `cpu`, `cores`, `gl_renderer` …; empty if unknown
    std::set<std::string> commits;  ///< of the program
};

struct MeasuredRuns {
    std::string from;  ///< the file or folder, for messages
    std::vector<MeasuredRun> runs{};
    std::vector<MachineFacts> machines{};  ///< one or more
    std::size_t notDone = 0, invalid = 0;
    std::map<std::string, std::size_t> whyInvalid{};  ///< number of runs by reason
};

/// Reads a results folder, a folder with a summary.csv, or such a file. A machine.csv next to it describes the machine.
/// Throws InputError with the file.
[[nodiscard]] MeasuredRuns readMeasuredRuns(const std::filesystem::path& from);
/// The same for a table alone. Throws InputError with `from` if one of the columns that every table needs is missing.
[[nodiscard]] MeasuredRuns measuredRuns(const files::CsvTable& table, const std::string& from);

/// One condition: `particles` is 500 or 2000.
struct Condition {
    std::string option;  ///< for messages: `--where`
    std::string key;     ///< `scene`, `size`, `particles` …
    std::vector<std::string> values;
};
/// Keeps the runs that meet every condition. Numbers are compared as numbers. Throws InputError for a key or values
/// that no remaining run has.
void narrow(MeasuredRuns& runs, const std::vector<Condition>& conditions);

}  // namespace dustbench::recommend
