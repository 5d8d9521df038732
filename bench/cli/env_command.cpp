// `dustbench env`: describes this machine, and reports disturbances of measurements and missing software.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/measure/energy.h"
#include "bench/results/run_record.h"
#include "bench/run/harness_cost.h"
#include "methods/contract/errors.h"
#include "methods/kit/gpu/egl_context.h"
#include "methods/kit/gpu/queue_marks.h"

namespace dustbench::cli {
namespace {

struct Found {
    measure::Provenance provenance;
    std::vector<gpu::Adapter> adapters;
    std::optional<run::HarnessCost> harness;
    bool cpuEnergy = false, gpuEnergy = false;
};

/// OpenGL may be missing: this command must report that.
void lookAtGpu(Found& found) {
    measure::Provenance& provenance = found.provenance;
    try {
        found.adapters = gpu::listAdapters();
        gpu::Device device;
        provenance.device = device.info();
        provenance.gpuTimersTrusted = gpu::timerQueriesAreTrue(device);
        if (device.isSoftware())
            provenance.warnings.push_back("no GPU: the CPU draws the pictures, on the same cores as everything else");
        if (!provenance.gpuTimersTrusted)
            provenance.warnings.push_back("this OpenGL's timer queries are wrong: gpu_ms stays empty");
    } catch (const InputError& error) {
        provenance.warnings.push_back(std::string("missing: ") + error.what());
    }
}

Found look() {
    // An unknown adapter is a user error, not a fact about the machine.
    if (const std::string asked = gpu::askedAdapter(); !asked.empty())
        (void)gpu::findAdapter(gpu::listAdapters(), asked);
    Found found;
    found.provenance = measure::startProvenance(measure::commandLine());
    lookAtGpu(found);
    try {
        found.harness = run::measureHarness(childExecution());
    } catch (const InputError& error) {
        found.provenance.warnings.push_back(std::string("missing: the harness's own cost: ") + error.what());
    }
    found.cpuEnergy = measure::packageEnergy() != nullptr;
    found.gpuEnergy = measure::gpuEnergy(found.provenance.device.renderer) != nullptr;
    return found;
}

/// Which of the energy columns will have values.
std::string energyText(const Found& found) {
    if (found.cpuEnergy) return found.gpuEnergy ? "CPU packages and GPU" : "CPU packages";
    return found.gpuEnergy ? "GPU" : "not available on this machine: the energy columns stay empty";
}

std::string json(const Found& found) {
    results::Columns cells{{"energy", energyText(found)}};
    if (found.harness) {
        cells.emplace_back("harness_us", found.harness->harnessUs);
        cells.emplace_back("harness_frame_ms", found.harness->frameMs);
        cells.emplace_back("start_s", found.harness->startSeconds);
    }
    return results::provenanceToJson(found.provenance, found.adapters, cells);
}

/// `1: surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), software; chosen: no hardware adapter: surfaceless`
std::string adapterText(const gpu::Adapter& adapter, const gpu::DeviceInfo& taken) {
    std::string text = fmt::format("{}: {}, ", adapter.index, adapter.name);
    if (!adapter.problem.empty()) return text + adapter.problem;
    if (adapter.platform == gpu::Adapter::Platform::surfaceless) text += adapter.renderer + ", ";
    text += gpu::kindName(adapter.kind);
    return adapter.index == taken.adapterIndex ? text + "; chosen: " + taken.adapterWhy : text;
}

void print(const Found& found) {
    const measure::Provenance& provenance = found.provenance;
    const auto line = [](const char* name, const std::string& value) {
        std::cout << fmt::format("{:<10} {}\n", name, value.empty() ? "unknown" : value);
    };
    const measure::Machine& machine = provenance.machine;
    const measure::BuildFacts& build = provenance.build;
    line("cpu", fmt::format("{}, {} cores", machine.cpu.empty() ? "unknown" : machine.cpu, machine.cores));
    line("governor", machine.governor);
    line("memory", fmt::format("{:.1f} GiB", static_cast<double>(machine.ramBytes) / (1 << 30)));
    line("kernel", machine.kernel + (machine.virtualMachine ? ", in a virtual machine" : ""));
    line("load", fmt::format("{:.2f}", machine.loadAverage));
    line("renderer", provenance.device.renderer);
    line("opengl", provenance.device.version.empty()
                       ? "none"
                       : fmt::format("{} ({}, EGL {})", provenance.device.version, provenance.device.vendor,
                                     provenance.device.platform));
    for (const gpu::Adapter& adapter : found.adapters) line("adapter", adapterText(adapter, provenance.device));
    line("energy", energyText(found));
    line("clock", fmt::format("{:.0f} ns per reading, {:.0f} ns per stage", provenance.clock.readingNs,
                              provenance.clock.stageNs));
    if (found.harness)
        line("harness",
             fmt::format("{:.1f} µs per frame; null method: {:.1f} ms per frame, {:.2f} s to the first frame",
                         found.harness->harnessUs, found.harness->frameMs, found.harness->startSeconds));
    line("program", fmt::format("dustbench {}{}{}", build.version, build.gitCommit.empty() ? "" : " " + build.gitCommit,
                                build.gitDirty ? " with uncommitted changes" : ""));
    line("build", fmt::format("{} {} {}", build.buildType, build.compiler, build.flags));
    for (const std::string& warning : provenance.warnings) line("attention", warning);
}

}  // namespace

Command envCommand() {
    auto asJson = std::make_shared<bool>(false);
    return {"env", "Describe this machine, disturbances of measurements and missing software", "",
            [asJson](Arguments& arguments) { arguments.flag("--json", "print JSON", *asJson); },
            [asJson] {
                const Found found = look();
                if (*asJson)
                    std::cout << json(found);
                else
                    print(found);
                return static_cast<int>(exitOk);
            }};
}

}  // namespace dustbench::cli
