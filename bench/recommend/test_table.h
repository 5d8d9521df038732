// For tests: a small summary.csv with rows written by hand.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench/recommend/measured_runs.h"

namespace dustbench::recommend {

/// One run; times and qualities as text, so that they may be empty or wrong.
struct TestRow {
    std::string method = "a", ms{}, psnr{};
    int particles = 500, seed = 1, repetition = 1;
    std::string status = "done", invalid{}, size = "320", frames = "40", reference = "exact", depth = "8",
                dustOn = "cpu";
};

inline std::string tableOf(const std::vector<TestRow>& rows) {
    std::string text =
        "run_id,status,method,scene,drive,seed,repetition,width,height,sync,threads,frames,p.particles,p.depth,"
        "method_ms_median,psnr_mask_db,rmse_linear_mask,popping,metric_reference,invalid,dust_on\n";
    int index = 0;
    for (const TestRow& row : rows)
        text += fmt::format("run{},{},{},plain,straight,{},{},{},240,frame,2,{},{},{},{},{},{},{},{},{},{}\n", ++index,
                            row.status, row.method, row.seed, row.repetition, row.size, row.frames, row.particles,
                            row.depth, row.ms, row.psnr, row.psnr.empty() ? "" : "0.01", row.psnr.empty() ? "" : "0.5",
                            row.psnr.empty() ? "" : row.reference, row.invalid, row.dustOn);
    return text;
}

inline MeasuredRuns runsOf(const std::vector<TestRow>& rows) {
    return measuredRuns(files::CsvTable::parseText(tableOf(rows), "summary.csv"), "summary.csv");
}

/// Runs of one setting, one repetition for each time. Only the first has metrics.
inline void add(std::vector<TestRow>& rows, const std::string& method, const std::vector<double>& ms,
                const std::string& psnr, int particles = 500) {
    for (std::size_t index = 0; index < ms.size(); ++index)
        rows.push_back({.method = method,
                        .ms = fmt::format("{}", ms[index]),
                        .psnr = index == 0 ? psnr : "",
                        .particles = particles,
                        .repetition = static_cast<int>(index) + 1});
}

}  // namespace dustbench::recommend
