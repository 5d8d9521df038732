// `dustbench selfcheck`: is this machine fit for measurements, and does its OpenGL draw right?
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <thread>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/text_table.h"
#include "bench/export/whole_file.h"
#include "bench/results/temporary_folder.h"
#include "bench/selfcheck/machine_checks.h"
#include "bench/selfcheck/picture_checks.h"
#include "bench/selfcheck/selfcheck_report.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

using Checks = std::vector<selfcheck::Check>;

void append(Checks& checks, Checks more) {
    std::ranges::move(more, std::back_inserter(checks));
}

/// Correctness first: rates of a device that computes wrongly mean nothing, but are measured all the same.
void checkDevice(measure::Provenance& provenance, Checks& checks) {
    gpu::Device device;
    provenance.device = device.info();
    const auto clock = measure::gpuClock(device.info().renderer);
    const auto read = [&] { return clock ? std::optional(clock->read()) : std::nullopt; };
    selfcheck::GpuClockReadings readings{.before = read()};
    append(checks, selfcheck::correctnessChecks(device));
    const selfcheck::DeviceRates rates = selfcheck::measureRates(device, [&] { readings.during = read(); });
    device.finish();
    readings.after = read();
    append(checks, selfcheck::rateChecks(rates, device.isSoftware()));
    checks.push_back(selfcheck::gpuClockCheck(readings));
}

void printChecks(const measure::Provenance& provenance, const Checks& checks) {
    std::vector<std::vector<std::string>> rows{{"check", "outcome", "measured", "expected", "note"}};
    for (const selfcheck::Check& check : checks)
        rows.push_back({check.name, std::string(selfcheck::outcomes.wordOf(check.outcome)), check.measured,
                        check.expected, check.note});
    std::cout << provenance.device.renderer << "\n" << textTable(std::move(rows));
}

int selfcheck(const std::string& out, bool json) {
    requireOpenGl();
    const fs::path file = files::findData("list of pictures", "selfcheck", "pictures", ".toml");
    const std::vector<selfcheck::PlannedPicture> planned = selfcheck::readPlannedPictures(file);
    std::optional<results::TemporaryFolder> temporary;
    if (out.empty()) temporary.emplace();
    const fs::path drawn = (temporary ? temporary->path() : fs::path(out)) / "pictures";
    std::error_code error;
    fs::create_directories(drawn, error);
    if (error) throw InputError("output '" + out + "' cannot be written: " + error.message());

    measure::Provenance provenance = measure::startProvenance(measure::commandLine());
    Checks checks = selfcheck::machineChecks(provenance);
    std::cerr << "device …" << std::endl;
    checkDevice(provenance, checks);
    run::ExecutionOptions execution = childExecution();
    execution.timeoutSeconds = 60;
    execution.simultaneous = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 4u));
    ProgressPrinter progress(execution.simultaneous == 1);
    append(checks, selfcheck::pictureChecks(planned, file.parent_path(), drawn, execution, progress));
    progress.eraseBar();
    checks.push_back(selfcheck::throttlingCheck(provenance.machine, measure::readMachine()));

    const std::string document = selfcheck::selfcheckJson(provenance, checks);
    if (!out.empty()) exports::writeWhole(fs::path(out) / "selfcheck.json", document);
    json ? static_cast<void>(std::cout << document) : printChecks(provenance, checks);
    const auto failed = std::ranges::find(checks, selfcheck::Outcome::failed, &selfcheck::Check::outcome);
    if (failed == checks.end()) return exitOk;
    std::cerr << "dustbench: selfcheck: " << failed->name << ": got " << failed->measured << ", expected "
              << failed->expected << std::endl;
    return exitRunFailed;
}

}  // namespace

Command selfcheckCommand() {
    auto out = std::make_shared<std::string>();
    auto json = std::make_shared<bool>(false);
    return {"selfcheck", "Check that this machine is fit for measurements and that its GPU draws correctly",
            "Takes up to 3 minutes without a GPU. Draws a picture of each method and compares it with its reference; "
            "tests\nblending, formats, atomics, barriers and timers; measures the device's rates. Exit code 1: a "
            "check failed.",
            [out, json](Arguments& arguments) {
                arguments.text("--out", "DIR", "keep selfcheck.json and the pictures here", *out);
                arguments.flag("--json", "one object", *json);
            },
            [out, json] { return selfcheck(*out, *json); }};
}

}  // namespace dustbench::cli
