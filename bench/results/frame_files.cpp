#include "bench/results/frame_files.h"

#include <fmt/format.h>

#include <iterator>

#include "methods/kit/files/csv.h"

namespace dustbench::bench {

using files::csvCell;
using files::csvNumber;

std::string framesCsv(std::span<const FrameRecord> frames) {
    std::string text = "frame,time_s,frame_ms";
    const auto out = std::back_inserter(text);
    for (const std::string_view stage : stageNames) fmt::format_to(out, ",{}_ms", stage);
    text += ",gpu_ms,particles,primitives,cpu_bytes,gpu_bytes,rss_bytes\n";
    for (const FrameRecord& frame : frames) {
        fmt::format_to(out, "{},{},{}", frame.frame, csvNumber(frame.timeSeconds), csvNumber(frame.frameMs));
        for (const double ms : frame.stageMs) fmt::format_to(out, ",{}", csvNumber(ms));
        fmt::format_to(out, ",{}", frame.gpuMs ? csvNumber(*frame.gpuMs) : "");
        fmt::format_to(out, ",{},{},{},{},{}\n", frame.particles, frame.primitives, frame.cpuBytes, frame.gpuBytes,
                       frame.rssBytes);
    }
    return text;
}

std::string stagesCsv(std::span<const FrameRecord> frames) {
    std::string text = "frame,stage,detail,ms\n";
    for (const FrameRecord& frame : frames)
        for (const FrameRecord::Detail& detail : frame.details)
            fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", frame.frame,
                           stageNames[static_cast<std::size_t>(detail.stage)], csvCell(detail.name),
                           csvNumber(detail.ms));
    return text;
}

}  // namespace dustbench::bench
