#include "bench/cli/shared_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "bench/export/exporter.h"
#include "bench/results/input_files.h"
#include "bench/run/method_host.h"
#include "bench/suite/value_list.h"
#include "bench/world/cameras.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::cli {

suite::ParameterLists parseParameters(const std::vector<std::string>& texts) {
    suite::ParameterLists lists;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos) throw InputError("-P: got '" + text + "', expected name=value");
        const std::string name = text.substr(0, equals);
        if (std::ranges::find(lists, name, &suite::ParameterLists::value_type::first) != lists.end())
            throw InputError("-P: parameter " + name + " is given twice; for several values, use a list: " + name +
                             "=a,b");
        lists.emplace_back(name, suite::expandValues(name, text.substr(equals + 1)));
    }
    return lists;
}

void checkWorlds(const std::vector<suite::PlannedRun>& plan) {
    std::set<std::tuple<std::string, std::string, results::ParameterTexts, std::string>> seen;
    for (const suite::PlannedRun& run : plan) {
        const auto parameters = results::resolveParameters(findMethod(run.spec.method), run.spec.parameters);
        (void)results::dataFilesOf(parameters.method);
        const std::string dust = fmt::format("{}\n{}\n{}\n{}", run.spec.dust, run.spec.dustColumns, run.spec.frames,
                                             results::dustPlaces.wordOf(run.spec.dustOn));
        if (!seen.emplace(run.spec.scene, run.spec.drive, parameters.world.canonical(), dust).second) continue;
        world::World loads(run.spec.scene, run.spec.drive, parameters.world, run.spec.seed);
        loads.useDust(results::givenDust(run.spec));
        run::requireDustPlace(run.spec, loads);
    }
}

void WorldOptions::declare(Arguments& arguments) {
    arguments.required("--method", "ID", "one of `dustbench list methods`", method);
    declareWorld(arguments);
    arguments.texts("--at", "TIMEs:name=value",
                    "change a setting of the method during the run, this many seconds after its first recorded "
                    "frame: 2.5s:velocity.speed=8",
                    changes);
}

suite::ParameterLists WorldOptions::parameterLists() const {
    suite::ParameterLists lists = parseParameters(parameters);
    if (changes.empty()) return lists;
    const MethodInfo& info = findMethod(method);
    const auto& declared = info.parameters.all();
    const auto parameter = std::ranges::find(declared, ParameterType::changes, &Parameter::type);
    if (parameter == declared.end())
        throw InputError("--at: got '" + changes.front() + "', but method '" + info.id +
                         "' has no setting that can change during a run");
    std::string all;
    for (const std::string& change : changes) all.append(all.empty() ? "" : ";").append(change);
    lists.emplace_back(parameter->name, std::vector{all});
    return lists;
}

void WorldOptions::declareWorld(Arguments& arguments) {
    arguments.text("--scene", "ID", "one of `dustbench list scenes`, or a .toml file", scene);
    arguments.text("--drive", "ID", "one of `dustbench list drives`, or a .csv file; default: the scene's own", drive);
    arguments.text(
        "--camera-path", "FILE",
        "key-framed camera instead of the parameter `camera`: CSV with time_s, eye_x, eye_y, eye_z, target_x, "
        "target_y, target_z, fov_deg; or its rows, separated by ';'",
        cameraPath);
    arguments.text(
        "--dust", "FILE",
        "particles from another program instead of the scene's dust: .vtp, .vdb, .csv, a volume, or a series of them, "
        ".pvd or .series, whose first moment is frame 0",
        dust);
    arguments.text("--dust-columns", "key=NAME,…",
                   "names of its columns, by the keys position, radius, opacity, mass, age, lifetime, id, velocity, "
                   "colour, time, scale, up; or a .toml file with them; default: the usual names",
                   dustColumns);
    arguments.text("--dust-on", "cpu|gpu|auto",
                   "where the scene's dust is simulated; auto: on the GPU if it is hardware and has shaders for all "
                   "parts of the dust",
                   dustOn);
    arguments.texts("-P", "name=value", "set a parameter of the method or of the world", parameters);
    arguments.integer("--warmup", "unrecorded frames before frame 0", warmup, 0, 10'000'000);
    arguments.text("--size", "WxH", "size of the picture in pixels", size);
    arguments.integer("--seed", "seed of all random numbers", seed, 0);
    arguments.integer("--threads", "CPU threads, including those of a software rasteriser; 0: one per core", threads, 0,
                      1024);
}

results::RunSpec WorldOptions::toSpec() const {
    const std::string id = findMethod(method).id;
    results::RunSpec spec = toWorldSpec();
    spec.method = id;
    return spec;
}

results::RunSpec WorldOptions::toWorldSpec() const {
    results::RunSpec spec;
    spec.scene = scene;
    spec.drive = drive;
    (void)files::findData("scene", "scenes", spec.scene, ".toml");
    if (!spec.drive.empty()) (void)files::findData("drive", "drives", spec.drive, ".csv");
    spec.cameraPath = cameraPath;
    if (!cameraPath.empty()) (void)world::CameraPath::read(cameraPath);
    spec.dust = dust;
    spec.dustColumns = dustColumns;
    spec.dustOn = results::dustPlaces.parse("--dust-on", dustOn);
    spec.warmup = warmup;
    spec.size = results::parseSize(size);
    spec.seed = static_cast<std::uint64_t>(seed);
    spec.threads = static_cast<int>(threads);
    return spec;
}

void VolumeOptions::declareRequired(Arguments& arguments) {
    arguments.required(framesName_, "A:B:STEP", "every STEP-th frame from A to B, excluding B; also A:B, or A alone",
                       frames_);
    declareRest(arguments);
}

void VolumeOptions::declareOptional(Arguments& arguments) {
    arguments.text(framesName_, "A:B:STEP", "write volumes of every STEP-th frame from A to B, excluding B", frames_);
    declareRest(arguments);
}

void VolumeOptions::declareRest(Arguments& arguments) {
    std::string formats;
    for (const exports::Exporter& exporter : exports::exporters())
        formats += fmt::format("{}{} ({})", formats.empty() ? "" : ", ", exporter.id, exporter.kind);
    arguments.text("--format", "NAME,NAME…", "formats of volumes: " + formats + "; default: vti", formats_);
    arguments.text("--resolution", "N", "voxels along the longest edge of a grid, at most 2048; default: 128",
                   resolution_);
    arguments.text("--region", "x0,y0,z0,x1,y1,z1",
                   "box that the grids cover, in metres; default: the extent of each frame's cloud", region_);
    for (const exports::ExporterOption& option : exports::exporterOptions())
        arguments.text(option.commandName(), fmt::format("{}", fmt::join(option.words, "|")), option.help,
                       options_[option.id]);
}

std::optional<exports::VolumeSettings> VolumeOptions::over(const std::optional<exports::VolumeSettings>& base) const {
    if (!base && frames_.empty()) {
        std::vector<std::pair<std::string, bool>> all{
            {"--format", !formats_.empty()}, {"--resolution", !resolution_.empty()}, {"--region", !region_.empty()}};
        for (const exports::ExporterOption& option : exports::exporterOptions())
            all.emplace_back(option.commandName(), !options_.at(option.id).empty());
        for (const auto& [name, given] : all)
            if (given) throw InputError(name + ": given without " + framesName_ + ", which selects the frames");
        return std::nullopt;
    }
    exports::VolumeSettings settings = base.value_or(exports::VolumeSettings());
    if (!frames_.empty()) settings.frames = exports::parseFrameRange(framesName_, frames_);
    if (!formats_.empty()) settings.formats = exports::parseFormats(formats_);
    if (!resolution_.empty()) settings.resolution = exports::parseResolution(resolution_);
    if (!region_.empty()) settings.region = exports::parseRegion(region_);
    for (const auto& [id, word] : options_)
        if (!word.empty()) settings.setOption(id, word);
    return settings;
}

}  // namespace dustbench::cli
