// `dustbench env`: what this machine is, what will disturb a measurement, what is missing.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/run/run_record.h"
#include "methods/shared/errors.h"
#include "methods/shared/gpu/timer_query.h"

namespace dustbench::cli {
namespace {

/// OpenGL may be missing: that is what this command is there to say.
void lookAtGpu(bench::Provenance& provenance) {
    try {
        gpu::Device device;
        provenance.device = device.info();
        provenance.gpuTimersTrusted = gpu::timerQueriesAreTrue(device);
        if (bench::isSoftwareRenderer(provenance.device))
            provenance.warnings.push_back(
                "no GPU: pictures are drawn by the CPU, whose cores they share with the rest");
        if (!provenance.gpuTimersTrusted)
            provenance.warnings.push_back("this OpenGL's timer queries are not true: gpu_ms stays empty");
    } catch (const InputError& error) {
        provenance.warnings.push_back(std::string("missing: ") + error.what());
    }
}

void print(const bench::Provenance& provenance) {
    const auto line = [](const char* name, const std::string& value) {
        std::cout << fmt::format("{:<10} {}\n", name, value.empty() ? "unknown" : value);
    };
    const bench::Machine& machine = provenance.machine;
    const bench::BuildFacts& build = provenance.build;
    line("cpu", fmt::format("{}, {} cores", machine.cpu.empty() ? "unknown" : machine.cpu, machine.cores));
    line("governor", machine.governor);
    line("memory", fmt::format("{:.1f} GiB", static_cast<double>(machine.ramBytes) / (1 << 30)));
    line("kernel", machine.kernel);
    line("load", fmt::format("{:.2f}", machine.loadAverage));
    line("renderer", provenance.device.renderer);
    line("opengl", provenance.device.version.empty()
                       ? "none"
                       : fmt::format("{} ({}, EGL {})", provenance.device.version, provenance.device.vendor,
                                     provenance.device.platform));
    line("program", fmt::format("dustbench {}{}{}", build.version, build.gitCommit.empty() ? "" : " " + build.gitCommit,
                                build.gitDirty ? " with uncommitted changes" : ""));
    line("build", fmt::format("{} {} {}", build.buildType, build.compiler, build.flags));
    for (const std::string& warning : provenance.warnings) line("attention", warning);
}

}  // namespace

Command envCommand() {
    auto json = std::make_shared<bool>(false);
    return {"env", "What this machine is, what will disturb a measurement, what is missing", "",
            [json](Arguments& arguments) { arguments.flag("--json", "one object", *json); },
            [json] {
                bench::Provenance provenance = bench::startProvenance(bench::commandLine());
                lookAtGpu(provenance);
                if (*json)
                    std::cout << bench::provenanceToJson(provenance);
                else
                    print(provenance);
                return static_cast<int>(exitOk);
            }};
}

}  // namespace dustbench::cli
