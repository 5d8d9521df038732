#include "methods/grid_fluid/precision/precision_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/precision/staggered_flow.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::grid_fluid::precision {
namespace {

namespace fs = std::filesystem;
using files::csvNumber;

constexpr std::string_view timeColumns = "problem,cells,solver,scheme,computing_ms\n";
constexpr std::string_view pointColumns =
    "problem,cells,solver,scheme,seconds,ms_per_second,ms_per_second_low,ms_per_second_high,repetitions,mass_m3,"
    "energy_m5_per_s2,divergence_per_step,reference,reference_scheme,reference_cells,compared_cells,density_error,"
    "velocity_error,"
    "enstrophy_error,spectrum_error\n";

[[noreturn]] void cannotWrite(const fs::path& file) {
    throw InputError(file.string() + ": cannot be written; check the folder and its free space");
}

void writeText(const fs::path& file, std::string_view text, std::ios::openmode mode = std::ios::out) {
    std::ofstream to(file, mode | std::ios::binary);
    to << text;
    if (!to.flush()) cannotWrite(file);
}

/// The flow of one solver and scheme on one grid.
struct Run {
    std::string problem;
    int cells = 0;
    std::string solver, scheme;
    fs::path file;

    [[nodiscard]] std::string key() const { return fmt::format("{},{},{},{}", problem, cells, solver, scheme); }
};

/// The grid as described in problem.toml.
struct Grid {
    double spacingMetres = 0, stepSeconds = 0, seconds = 0;
    std::vector<std::uint8_t> solids;
};

Grid gridOf(const fs::path& place) {
    files::TomlReader toml = files::TomlReader::parseFile(place / "problem.toml");
    Grid grid;
    grid.spacingMetres = toml.number("spacing_metres", 1e-6, 1e6);
    grid.stepSeconds = toml.number("step_seconds", 1e-9, 1e6);
    grid.seconds = grid.stepSeconds * static_cast<double>(toml.integer("steps", 1, 1'000'000));
    std::ifstream from(place / "solids.f32", std::ios::binary);
    for (float solid = 0; from.read(reinterpret_cast<char*>(&solid), sizeof solid);)
        grid.solids.push_back(solid > 0 ? 1 : 0);
    return grid;
}

/// All flows of a folder except the initial ones, sorted.
std::vector<Run> runsIn(const fs::path& folder) {
    std::vector<Run> runs;
    for (const fs::directory_entry& place : fs::directory_iterator(folder)) {
        const std::string name = place.path().filename().string();
        const std::size_t mark = name.rfind('_');
        const auto cells = mark == std::string::npos ? std::nullopt : files::numberOf(name.substr(mark + 1));
        if (!place.is_directory() || !cells) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(place)) {
            const fs::path& file = entry.path();
            const std::string stem = file.stem().string();
            const std::size_t dash = stem.find('-');
            if (file.extension() == ".flow" && dash != std::string::npos)
                runs.push_back({name.substr(0, mark), static_cast<int>(*cells), stem.substr(0, dash),
                                stem.substr(dash + 1), file});
        }
    }
    std::ranges::sort(runs, {},
                      [](const Run& run) { return std::tuple(run.problem, run.cells, run.solver, run.scheme); });
    return runs;
}

/// Milliseconds, sorted, by Run::key.
std::map<std::string, std::vector<double>> timesIn(const fs::path& file) {
    std::map<std::string, std::vector<double>> times;
    if (!fs::exists(file)) return times;
    const files::CsvTable table = files::CsvTable::parseFile(file);
    for (std::size_t row = 0; row < table.rows(); ++row)
        times[fmt::format("{},{},{},{}", table.cell(row, "problem"), table.cell(row, "cells"),
                          table.cell(row, "solver"), table.cell(row, "scheme"))]
            .push_back(table.number(row, "computing_ms"));
    for (auto& [key, values] : times) std::ranges::sort(values);
    return times;
}

/// Median, minimum, maximum, number; empty if there are none.
std::string timeCells(const std::vector<double>& sorted, double seconds) {
    if (sorted.empty()) return ",,,0";
    const std::size_t n = sorted.size();
    const double median = (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
    return fmt::format("{},{},{},{}", csvNumber(median / seconds), csvNumber(sorted.front() / seconds),
                       csvNumber(sorted.back() / seconds), n);
}

bool isFinest(const Run& run, const std::vector<Run>& runs) {
    return std::ranges::none_of(
        runs, [&](const Run& other) { return other.solver == run.solver && other.cells > run.cells; });
}

StaggeredFlow flowOn(const Run& run, int coarseCells) {
    StaggeredFlow flow = readFlow(run.file);
    const int refinement = run.cells / coarseCells;
    if (refinement * coarseCells != run.cells || flow.cells % refinement != glm::ivec3(0))
        throw InputError(fmt::format("{}: got {} cells across, allowed: a multiple of the coarsest grid's {}",
                                     run.file.string(), run.cells, coarseCells));
    return refinement == 1 ? flow : averaged(flow, refinement);
}

}  // namespace

PrecisionFolder::PrecisionFolder(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (!fs::is_directory(folder_)) cannotWrite(folder_);
}

fs::path PrecisionFolder::placeOf(std::string_view problem, int cells) const {
    return folder_ / fmt::format("{}_{}", problem, cells);
}

void PrecisionFolder::writeSetUp(std::string_view problem, int cells, const GridProblem& set) const {
    const fs::path place = placeOf(problem, cells);
    std::error_code ignored;
    fs::create_directories(place, ignored);
    writeFlow(place / "begin.flow", set.begin);
    std::vector<float> solids(set.begin.density.size(), 0);
    if (!set.solids.empty()) std::ranges::copy(set.solids, solids.begin());
    writeFloats(place / "solids.f32", solids);
    flow::FluidSource source;
    if (set.sources.empty()) {
        std::ranges::fill(solids, 0);
        writeFloats(place / "source.f32", solids);
    } else {
        source = set.sources.front();
        writeFloats(place / "source.f32", strengthsOf(source, set));
    }
    const auto& sides = set.settings.sides;
    const auto wordOf = [](flow::Side side) {
        return side == flow::Side::wall ? "wall" : side == flow::Side::open ? "open" : "inflow";
    };
    const glm::vec3& wind = set.settings.windMetresPerSecond;
    writeText(place / "problem.toml",
              fmt::format("cells = [{}, {}, {}]\nspacing_metres = {}\nstep_seconds = {}\nsteps = {}\n"
                          "sides = [\"{}\", \"{}\", \"{}\", \"{}\", \"{}\", \"{}\"]  # -x, +x, -y, +y, -z, +z\n"
                          "wind_metres_per_second = [{}, {}, {}]\nlift_m_per_s2_per_kelvin = {}  # along +y\n"
                          "density_per_second = {}\nkelvin_per_second = {}\ndivergence_per_step = {}\n",
                          set.begin.cells.x, set.begin.cells.y, set.begin.cells.z,
                          csvNumber(set.settings.box.spacingMetres), csvNumber(set.stepSeconds), set.steps,
                          wordOf(sides[0]), wordOf(sides[1]), wordOf(sides[2]), wordOf(sides[3]), wordOf(sides[4]),
                          wordOf(sides[5]), wind.x, wind.y, wind.z, set.settings.forces.buoyancyPerKelvin,
                          source.densityPerSecond, source.kelvinPerSecond, set.settings.divergencePerStep));
}

bool PrecisionFolder::hasFlow(std::string_view problem, int cells, std::string_view scheme) const {
    return fs::exists(placeOf(problem, cells) / fmt::format("{}-{}.flow", ownSolver, scheme));
}

void PrecisionFolder::addRun(std::string_view problem, int cells, std::string_view scheme,
                             const SolvedProblem& solved) const {
    writeFlow(placeOf(problem, cells) / fmt::format("{}-{}.flow", ownSolver, scheme), solved.end);
    const fs::path times = folder_ / "times.csv";
    if (!fs::exists(times)) writeText(times, timeColumns);
    writeText(
        times,
        fmt::format("{},{},{},{},{}\n", problem, cells, ownSolver, scheme, csvNumber(1000 * solved.computingSeconds)),
        std::ios::app);
}

std::size_t PrecisionFolder::writePoints(int referenceCells) const {
    const std::vector<Run> runs = runsIn(folder_);
    const auto times = timesIn(folder_ / "times.csv");
    std::string text(pointColumns);
    std::size_t rows = 0;
    for (const auto& [word, kind] : problemKinds.all()) {
        std::vector<Run> ofProblem;
        std::ranges::copy_if(runs, std::back_inserter(ofProblem), [&](const Run& run) { return run.problem == word; });
        if (ofProblem.empty()) continue;
        const int coarsest = ofProblem.front().cells;
        std::vector<std::pair<Run, StaggeredFlow>> references;
        for (const Run& run : ofProblem)
            if (run.cells >= referenceCells && isFinest(run, ofProblem))
                references.emplace_back(run, flowOn(run, coarsest));
        for (const Run& run : ofProblem) {
            const Grid grid = gridOf(run.file.parent_path());
            const FlowSums sums = sumsOf(readFlow(run.file), grid.solids, grid.spacingMetres, grid.stepSeconds);
            const StaggeredFlow flow = flowOn(run, coarsest);
            const auto found = times.find(run.key());
            for (const auto& [reference, expected] : references) {
                if (run.file == reference.file) continue;
                const FlowDistance distance = distanceOf(flow, expected);
                text += fmt::format(
                    "{},{},{},{},{},{},{},{},{},{},{},{}\n", run.key(), csvNumber(grid.seconds),
                    timeCells(found == times.end() ? std::vector<double>() : found->second, grid.seconds),
                    csvNumber(sums.massM3), csvNumber(sums.energyM5PerS2), csvNumber(sums.divergencePerStep),
                    fmt::format("{},{},{}", reference.solver, reference.scheme, reference.cells), coarsest,
                    csvNumber(distance.density), csvNumber(distance.velocity), csvNumber(distance.enstrophy),
                    csvNumber(distance.spectrum));
                ++rows;
            }
        }
    }
    writeText(folder_ / "points.csv", text);
    return rows;
}

}  // namespace dustbench::grid_fluid::precision
