// Compares a picture of each method, drawn on this machine, with its reference: a picture that was looked at and kept
// (data/selfcheck), the ground truth computed on the CPU, or the same method on the CPU.
//
// Each picture is drawn in a process of its own, so that a driver that crashes or hangs fails one check.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/executor.h"
#include "bench/selfcheck/selfcheck_report.h"

namespace dustbench::selfcheck {

struct PlannedPicture {
    enum class Reference { kept, exact, variant };

    std::string name;
    Reference reference = Reference::kept;
    results::RunSpec spec;
    std::optional<results::RunSpec> variant{};  ///< the run whose picture is the reference
    double flipLimit = 0;
    std::string skip{};  ///< why it cannot be drawn; empty if it can
};

/// Reads `data/selfcheck/pictures.toml`, which documents its keys. A picture of a method that this build lacks is
/// planned with the reason to skip it. Throws InputError.
[[nodiscard]] std::vector<PlannedPicture> readPlannedPictures(const std::filesystem::path& file);

/// Draws all of them, `options.simultaneous` at a time, and compares. Kept pictures are `kept`/NAME.png. The pictures
/// drawn here are left as `drawn`/NAME.png, with NAME.difference.png where a check fails. Methods without a picture are
/// named in a check of their own.
[[nodiscard]] std::vector<Check> pictureChecks(const std::vector<PlannedPicture>& planned,
                                               const std::filesystem::path& kept, const std::filesystem::path& drawn,
                                               const run::ExecutionOptions& options, run::ExecutionListener& listener);

}  // namespace dustbench::selfcheck
