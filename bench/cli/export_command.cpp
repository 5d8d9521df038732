// `dustbench export`: writes the volumes of a run without measuring it.
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/measure/provenance.h"
#include "bench/run/export_run.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::cli {
namespace {

struct ExportOptions {
    WorldOptions world;
    VolumeOptions volumes{"--frames"};
    std::string out;
};

suite::PlannedRun plannedExport(const ExportOptions& options) {
    results::RunSpec spec = options.world.toSpec();
    spec.volumes = options.volumes.over(exports::VolumeSettings());
    spec.frames = spec.volumes->frames.last + 1;
    const auto runs = suite::expandParameters(spec, findMethod(spec.method), options.world.parameterLists());
    if (runs.size() != 1)
        throw InputError("-P: got " + std::to_string(runs.size()) +
                         " combinations of values, allowed: one value for each parameter");
    results::requireChangesWithinRun(runs.front().spec);
    return runs.front();
}

int exportVolumes(const ExportOptions& options) {
    const suite::PlannedRun run = plannedExport(options);
    requireOpenGl();
    listenForInterruption();
    ProgressPrinter printer;
    printer.started(1, 1, run, 1, -1);
    const auto progress = [&printer](std::string_view phase, std::int64_t done, std::int64_t total) {
        printer.progressed(std::string(phase) + " " + std::to_string(done) + " " + std::to_string(total));
    };
    const run::ExportResult result =
        run::exportVolumes(run.spec, options.out, measure::commandLine(), progress, [] { return interrupted(); });
    printer.ended(run, results::RunStatus::done, "");
    for (const std::filesystem::path& series : result.series) std::cout << series.string() << "\n";
    if (result.gridsDiffer)
        std::cerr
            << "the frames have different grids: open extinction.pvd; ParaView shows extinction.vti.series correctly "
               "only if all grids are the same (--region)"
            << std::endl;
    if (!result.aborted) return exitOk;
    std::cerr << "aborted; the frames written so far are complete" << std::endl;
    return exitAborted;
}

}  // namespace

Command exportCommand() {
    auto options = std::make_shared<ExportOptions>();
    return {"export", "Write a method's volumes for ParaView, Blender, Houdini …",
            "Each frame has exactly the state that it has in `run`. Prints the series to open.\n"
            "reports/SCHEMA.md describes the files.",
            [options](Arguments& arguments) {
                options->world.declare(arguments);
                options->volumes.declareRequired(arguments);
                arguments.required("--out", "DIR", "folder for the files; created if missing", options->out);
            },
            [options] { return exportVolumes(*options); }};
}

}  // namespace dustbench::cli
