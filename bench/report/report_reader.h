// Reads a results folder for its report, and goes on where something in it is missing or damaged.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// Bytes of pictures that the page itself holds, unless told.
inline constexpr std::int64_t defaultPictureBytes = 12'000'000;

/// Everything that the page shows, with a sentence for each thing that it cannot. Throws InputError where `folder` is
/// no folder.
[[nodiscard]] ReportData readReport(const std::filesystem::path& folder, std::int64_t maximumPictureBytes);

}  // namespace dustbench::bench
