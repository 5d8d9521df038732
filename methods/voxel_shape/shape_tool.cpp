// `dustbench shape`: shows the voxels of a shape, edits them from the command line, and saves the result as a shape
// file or as voxels.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/contract/experiment.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"
#include "methods/voxel_shape/edit_text.h"
#include "methods/voxel_shape/living_shape.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"
#include "methods/voxel_shape/voxels/voxel_file.h"

namespace dustbench::voxel_shape::shape {
namespace {

namespace fs = std::filesystem;

constexpr Choices<EditKind> editOptions{{"--paint", EditKind::paint},
                                        {"--carve", EditKind::carve},
                                        {"--fill", EditKind::fill},
                                        {"--force", EditKind::force}};

struct Call {
    fs::path file;
    std::optional<fs::path> save;
    std::optional<double> seconds, every;  ///< if the shape is to move before it is saved
    std::string scene = "plain";
    std::vector<ToolArgument> edits;
};

constexpr double toolStepSeconds = 1.0 / 60;

double secondsOf(const ToolArgument& argument) {
    const auto seconds = files::numberOf(argument.value);
    if (!seconds || !(*seconds >= toolStepSeconds) || *seconds > 600)
        throw InputError(argument.name + ": got '" + argument.value + "', allowed: 0.0167..600 s");
    return *seconds;
}

Call callOf(std::span<const ToolArgument> arguments) {
    Call call;
    for (const ToolArgument& argument : arguments) {
        if (argument.name == "file")
            call.file = argument.value.ends_with(".vti") ? fs::path(argument.value)
                                                         : files::findData("shape", "shapes", argument.value, ".toml");
        else if (argument.name == "--save")
            call.save = argument.value;
        else if (argument.name == "--scene")
            call.scene = argument.value;
        else if (argument.name == "--seconds")
            call.seconds = secondsOf(argument);
        else if (argument.name == "--every")
            call.every = secondsOf(argument);
        else
            call.edits.push_back(argument);
    }
    if (call.save && call.save->extension() != ".toml" && call.save->extension() != ".vti")
        throw InputError("--save: got '" + call.save->string() + "', allowed: a file that ends in .toml or .vti");
    if (call.every && !call.seconds) throw InputError("--every: requires --seconds, the end of the series");
    if (call.seconds && (!call.save || call.save->extension() != ".vti"))
        throw InputError("--seconds: requires --save FILE.vti, because a shape file holds no particles");
    return call;
}

bool isVoxelFile(const fs::path& file) {
    return file.extension() == ".vti";
}

/// Returns the shape without a place in a scene, and without a file to save its voxels to.
Shape shapeOf(const fs::path& file) {
    Shape shape;
    if (isVoxelFile(file)) {
        shape.name = file.filename().string();
        shape.source = Source::voxels;
        shape.mesh = file;
    } else {
        shape = readShape(file);
    }
    shape.savedVoxels.clear();
    shape.track.followsVehicle = false;
    return shape;
}

VoxelGrid voxelsOf(MemoryLedger& ledger, const Shape& shape, const std::string& scene, ExperimentContext& context) {
    const auto world = shape.source == Source::vehicle ? context.world(scene, {}, 1, 1) : nullptr;
    return buildShape(ledger, shape, world ? world->scene() : scene::Scene(), context.device(), 1).grid();
}

void writeText(const fs::path& file, const std::string& text, const Shape& expected) {
    const fs::path part = file.string() + ".part";
    const auto fail = [&](const std::string& why) {
        std::error_code ignored;
        fs::remove(part, ignored);
        throw InputError(file.string() + ": " + why);
    };
    if (!(std::ofstream(part, std::ios::binary) << text << std::flush)) fail("the shape cannot be written there");
    // Read the file back: text in a form that withEdits does not recognise would be lost.
    try {
        const Shape again = readShape(part);
        const bool sameSource = fs::weakly_canonical(again.mesh) == fs::weakly_canonical(expected.mesh);
        if (again.edits.size() != expected.edits.size() || (expected.source != Source::vehicle && !sameSource))
            throw InputError("it would refer to other files");
    } catch (const InputError& error) {
        fail(std::string("the edits cannot be added to this shape file; save them as .vti (") + error.what() + ")");
    }
    std::error_code error;
    fs::rename(part, file, error);
    if (error) fail("the shape cannot be written there");
}

std::string textOf(const fs::path& file, const fs::path& folder, const std::string& edits) {
    if (isVoxelFile(file))
        return fmt::format("description = \"voxels of {}\"\nvoxels_from = \"{}\"\n{}", file.filename().string(),
                           fs::proximate(fs::absolute(file), fs::absolute(folder)).generic_string(), edits);
    return withEdits(files::wholeText(file, "a shape file"), file, folder, edits);
}

void save(const Call& call, const Shape& edited, const VoxelGrid& voxels) {
    if (isVoxelFile(*call.save)) return writeVoxels(voxels, *call.save);
    const fs::path folder = fs::absolute(*call.save).parent_path();
    std::string edits;
    for (const ToolArgument& edit : call.edits)
        edits += "\n[[edit]]\n" + editAsToml(editOptions.parse("edit", edit.name), edit.name, edit.value, folder);
    writeText(*call.save, textOf(call.file, folder, edits), edited);
}

/// ParaView's index of a series.
void writeSeries(const fs::path& file, const std::vector<std::pair<std::string, double>>& moments) {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (const auto& [name, seconds] : moments)
        text += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", seconds, name);
    if (!(std::ofstream(file, std::ios::binary) << text << "</Collection>\n</VTKFile>\n" << std::flush))
        throw InputError(file.string() + ": the series cannot be written there");
}

/// Moves the shape in its scene, and saves its voxels with the particles that they hold: at the end, or as a series.
/// Returns the number held at the end.
std::uint64_t saveMoved(const Call& call, const Shape& edited, ExperimentContext& context) {
    const auto world = context.world(call.scene, {}, 1, 1);
    MemoryLedger ledger;
    LivingShape living(edited);
    living.prepare(ledger, world->scene(), context.device(), context.seed());
    const auto stepsIn = [](double seconds) {
        return static_cast<std::int64_t>(std::llround(seconds / toolStepSeconds));
    };
    const std::int64_t last = stepsIn(*call.seconds), every = call.every ? stepsIn(*call.every) : 0;
    std::vector<std::pair<std::string, double>> moments;
    for (std::int64_t step = 1; step <= last; ++step) {
        living.step(world->step());
        if (every == 0 || step % every != 0) continue;
        const std::string name = fmt::format("{}_{:06}.vti", call.save->stem().string(), step);
        writeVoxels(living.system().grid(), call.save->parent_path() / name);
        moments.emplace_back(name, static_cast<double>(step) * toolStepSeconds);
        writeSeries(fs::path(*call.save).replace_extension(".pvd"), moments);
    }
    if (every == 0) writeVoxels(living.system().grid(), *call.save);
    std::uint64_t held = 0;
    for (const Voxel& voxel : living.system().grid().voxels()) held += voxel.density;
    return held;
}

/// Returns the number of active voxels with a force.
std::size_t forced(const VoxelGrid& grid) {
    const auto isForced = [&](std::uint32_t i) { return glm::length(grid.voxels()[i].force) > 0; };
    return static_cast<std::size_t>(std::ranges::count_if(grid.active(), isForced));
}

std::uint64_t particlesOf(const VoxelGrid& grid) {
    std::uint64_t sum = 0;
    for (const std::uint32_t i : grid.active()) sum += grid.voxels()[i].maximumDensity;
    return sum;
}

/// Counts the voxels that are active before and after and have a new colour.
std::size_t recoloured(const VoxelGrid& before, const VoxelGrid& after) {
    const auto changed = [&](std::uint32_t i) {
        const Voxel &a = before.voxels()[i], &b = after.voxels()[i];
        return a.isActive() && a.colour.colour() != b.colour.colour();
    };
    return static_cast<std::size_t>(std::ranges::count_if(after.active(), changed));
}

std::string place(const glm::vec3& p) {
    return fmt::format("{:.4g}, {:.4g}, {:.4g}", p.x, p.y, p.z);
}

std::vector<std::vector<std::string>> table(const VoxelGrid& before, const VoxelGrid& after) {
    const Lattice& lattice = after.lattice();
    const auto text = [](auto number) { return std::to_string(number); };
    return {{"", "before", "after"},
            {"active voxels", text(before.active().size()), text(after.active().size())},
            {"recoloured voxels", text(0), text(recoloured(before, after))},
            {"voxels with a force", text(forced(before)), text(forced(after))},
            {"particles held", text(particlesOf(before)), text(particlesOf(after))},
            {"voxels along x, y, z", "", place(lattice.counts)},
            {"edge of a voxel, m", "", fmt::format("{:.4g}", lattice.edgeMetres)},
            {"from, m", "", place(lattice.origin)},
            {"to, m", "", place(lattice.maximumCorner())}};
}

std::vector<std::vector<std::string>> edit(ExperimentContext& context, std::span<const ToolArgument> arguments) {
    const Call call = callOf(arguments);
    const Shape shape = shapeOf(call.file);
    Shape edited = shape;
    for (const ToolArgument& argument : call.edits)
        edited.edits.push_back(readEditWords(editOptions.parse("edit", argument.name), argument.name, argument.value));
    MemoryLedger ledger;
    const VoxelGrid before = voxelsOf(ledger, shape, call.scene, context);
    const VoxelGrid after = voxelsOf(ledger, edited, call.scene, context);
    if (!call.seconds) {
        if (call.save) save(call, edited, after);
        return table(before, after);
    }
    const std::uint64_t held = saveMoved(call, edited, context);
    auto shown = table(before, after);
    shown.push_back({fmt::format("particles after {} s", *call.seconds), "", std::to_string(held)});
    return shown;
}

}  // namespace

ToolInfo describe() {
    ToolInfo info;
    info.summary = "Show a voxel shape; paint, carve, fill or push it, and save it";
    info.manual =
        "An edit names a region and the changes to the voxels whose centres lie in it. Its words are the keys of\n"
        "shape files (data/shapes/car.toml): metres in the shape's own frame, linear RGB, lists with commas.\n"
        "  region  sphere=x,y,z,radius, swept along a line by to=x,y,z; box=x,y,z,x,y,z (minimum, maximum);\n"
        "          mesh=FILE [position=x,y,z] [scale=s]\n"
        "  paint   colour opacity size_voxels fading_colour fading_opacity fading_size_voxels lifetime_seconds\n"
        "          interpolation_seconds pictures_per_second maximum_density\n"
        "  force   kind=linear acceleration=x,y,z; kind=orbit|gravity|spiral|helix axis=x,y,z radians_per_second=w\n"
        "          growth_per_radian=k (spiral) metres_per_radian=k (helix)\n"
        "Edits apply in the order given, those of the shape file first. Voxels are added and removed before any\n"
        "look is set, since the particles are distributed over them.\n"
        "Example: dustbench shape bunny --carve \"sphere=0,1,0,0.4\" --paint \"box=-1.3,2,-1.1,0.6,2.7,0.4 "
        "colour=0,0,1\" "
        "--save blue.toml\n"
        "         dustbench run --method voxel_shape -P shape=blue.toml --out out/blue";
    info.options = {
        {"file", "FILE", "a shape of data/shapes, a shape file (.toml) or saved voxels (.vti)"},
        {"--paint", "EDIT", "changes the looks of voxels in a region: \"sphere=0,0.5,0,0.2 colour=0.8,0.1,0.1\"", true},
        {"--carve", "EDIT", "removes voxels from the shape: \"box=-1,0,-1,1,0.5,1\"", true},
        {"--fill", "EDIT", "adds voxels, which look like the nearest ones unless painted", true},
        {"--force", "EDIT", "pushes the particles in a region: \"sphere=0,1,0,0.5 kind=gravity radians_per_second=3\"",
         true},
        {"--save", "OUT",
         "writes a shape file (.toml) with these edits, or the voxels (.vti); replaces an existing one"},
        {"--seconds", "S",
         "moves the shape for S seconds before its voxels are saved, with the particles that they then hold (density)"},
        {"--every", "S", "saves a series instead: OUT_000030.vti after 30 steps …, and OUT.pvd for ParaView"},
        {"--scene", "ID", "the scene that the shape moves in, and whose vehicle it may be; default: plain"}};
    info.run = edit;
    return info;
}

}  // namespace dustbench::voxel_shape::shape
