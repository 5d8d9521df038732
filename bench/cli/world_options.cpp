#include "bench/cli/world_options.h"

#include <algorithm>

#include "bench/cli/shared_options.h"
#include "bench/scene/camera_path.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::cli {

void WorldOptions::declare(Arguments& arguments) {
    arguments.required("--method", "ID", "one of `dustbench list methods`", method);
    declareWorld(arguments);
    arguments.texts("--at", "TIMEs:name=value",
                    "change a setting of the method during the run, this many seconds after its first recorded "
                    "frame: 2.5s:velocity.speed=8",
                    changes);
}

bench::ParameterLists WorldOptions::parameterLists() const {
    bench::ParameterLists lists = parseParameters(parameters);
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

bench::RunSpec WorldOptions::toSpec() const {
    const std::string id = findMethod(method).id;
    bench::RunSpec spec = toWorldSpec();
    spec.method = id;
    return spec;
}

bench::RunSpec WorldOptions::toWorldSpec() const {
    bench::RunSpec spec;
    spec.scene = scene;
    spec.drive = drive;
    (void)files::findData("scene", "scenes", spec.scene, ".toml");
    if (!spec.drive.empty()) (void)files::findData("drive", "drives", spec.drive, ".csv");
    spec.cameraPath = cameraPath;
    if (!cameraPath.empty()) (void)bench::CameraPath::read(cameraPath);
    spec.dust = dust;
    spec.dustColumns = dustColumns;
    spec.dustOn = bench::dustPlaces.parse("--dust-on", dustOn);
    spec.warmup = warmup;
    spec.size = bench::parseSize(size);
    spec.seed = static_cast<std::uint64_t>(seed);
    spec.threads = static_cast<int>(threads);
    return spec;
}

}  // namespace dustbench::cli
