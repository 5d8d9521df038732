#include "bench/results/machine_table.h"

#include <array>
#include <string_view>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

constexpr std::array<std::string_view, 19> fields{
    "cpu",       "cores",      "ram_bytes",   "governor",   "virtual_machine", "kernel",  "gl_renderer",
    "gl_vendor", "gl_version", "gl_platform", "adapter",    "gpu_timers",      "version", "git_commit",
    "git_dirty", "compiler",   "flags",       "build_type", "started_utc"};

std::string fieldOf(const StoredRun& run, std::string_view field) {
    const auto found = run.provenance.find(field);
    return found == run.provenance.end() ? std::string() : found->second;
}

}  // namespace

std::string machineCsv(const StoredRuns& runs) {
    const StoredRun* first = nullptr;
    for (const auto& [id, run] : runs)
        if (run.status == RunStatus::done && (!first || fieldOf(run, "started_utc") < fieldOf(*first, "started_utc")))
            first = &run;
    if (!first) throw InputError("machine.csv: no run is done");
    std::string header, row;
    for (const std::string_view field : fields) {
        header.append(field).append(1, ',');
        row.append(files::csvCell(fieldOf(*first, field))).append(1, ',');
    }
    header.back() = row.back() = '\n';
    return header + row;
}

}  // namespace dustbench::bench
