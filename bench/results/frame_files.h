// Writes frames.csv and stages.csv.
#pragma once

#include <span>
#include <string>

#include "bench/measure/frame_record.h"

namespace dustbench::bench {

/// The text of frames.csv: one row per recorded frame.
[[nodiscard]] std::string framesCsv(std::span<const FrameRecord> frames);

/// The text of stages.csv: `frame,stage,detail,ms`, one row per frame and finer stage.
[[nodiscard]] std::string stagesCsv(std::span<const FrameRecord> frames);

}  // namespace dustbench::bench
