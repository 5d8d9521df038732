// `dustbench precision`: solves three problems on several grids, and compares the flows by error and time, including
// flows that other solvers have left in the same folder.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/contract/experiment.h"
#include "methods/grid_fluid/fluid_solids.h"
#include "methods/grid_fluid/precision/precision_folder.h"
#include "methods/kit/files/csv.h"

namespace dustbench::grid_fluid::precision {
namespace {

enum class Scheme { revertMidstep, revert, clamp, unlimited, semiLagrangian };
constexpr Choices<Scheme> schemes{{"revert_midstep", Scheme::revertMidstep},
                                  {"revert", Scheme::revert},
                                  {"clamp", Scheme::clamp},
                                  {"unlimited", Scheme::unlimited},
                                  {"semi_lagrangian", Scheme::semiLagrangian}};

flow::AdvectionRule ruleOf(Scheme scheme) {
    using enum flow::AdvectionScheme;
    switch (scheme) {
        case Scheme::revertMidstep:
            return {macCormack, flow::Limit::revert, flow::VelocityAt::middle};
        case Scheme::revert:
            return {macCormack, flow::Limit::revert};
        case Scheme::clamp:
            return {macCormack, flow::Limit::clamp};
        case Scheme::unlimited:
            return {macCormack, flow::Limit::none};
        case Scheme::semiLagrangian:
            break;
    }
    return {semiLagrangian, flow::Limit::none};
}

struct Call {
    std::filesystem::path folder;
    std::vector<ProblemKind> problems{ProblemKind::plume, ProblemKind::ring, ProblemKind::car};
    std::vector<Scheme> schemes{Scheme::revertMidstep, Scheme::revert, Scheme::clamp, Scheme::unlimited,
                                Scheme::semiLagrangian};
    std::vector<int> cells{16, 32, 64};
    int referenceCells = 128;
    int repetitions = 1;
};

int countOf(const std::string& name, const std::string& text, int minimum, int maximum) {
    const auto number = files::numberOf(text);
    if (!number || *number != std::floor(*number) || *number < minimum || *number > maximum)
        throw InputError(
            fmt::format("{}: got '{}', allowed: a whole number from {} to {}", name, text, minimum, maximum));
    return static_cast<int>(*number);
}

/// Applies `read` to each word of a list with commas; returns an empty list for `nothing`.
template <typename Read>
auto listOf(const std::string& text, const Read& read) {
    std::vector<decltype(read(text))> values;
    std::istringstream words(text);
    for (std::string word; text != "nothing" && std::getline(words, word, ',');) values.push_back(read(word));
    return values;
}

Call callOf(std::span<const ToolArgument> arguments) {
    Call call;
    for (const auto& [name, value] : arguments) {
        const auto cellsOf = [&](const std::string& text) {
            const int cells = countOf(name, text, 0, 256);
            if (cells > 0) checkCells(cells);
            return cells;
        };
        if (name == "folder")
            call.folder = value;
        else if (name == "--problem")
            call.problems = listOf(value, [&](const std::string& word) { return problemKinds.parse(name, word); });
        else if (name == "--scheme")
            call.schemes = listOf(value, [&](const std::string& word) { return schemes.parse(name, word); });
        else if (name == "--cells")
            call.cells = listOf(value, cellsOf);
        else if (name == "--reference")
            call.referenceCells = cellsOf(value);
        else
            call.repetitions = countOf(name, value, 1, 100);
    }
    return call;
}

/// The car of the scene `wind_tunnel`, at the same moment on all grids.
class Car {
 public:
    explicit Car(ExperimentContext& context) : context_(context) {}

    std::vector<std::uint8_t> operator()(flow::FluidBox box) {
        if (!world_) {
            world_ = context_.world("wind_tunnel", {}, 1, 1);
            frame_.emplace(world_->step());
        }
        box.originMetres += frame_->state.vehicle.position;
        MemoryLedger ledger;
        FluidSolids solids(world_->scene(), box.cells, ledger.account("solids"));
        (void)solids.voxelise(box, frame_->state);
        std::vector<std::uint8_t> inside(solids.bodies().begin(), solids.bodies().end());
        for (std::uint8_t& cell : inside) cell = cell == 0 ? 0 : 1;
        return inside;
    }

 private:
    ExperimentContext& context_;
    std::unique_ptr<ExperimentWorld> world_;
    std::optional<Frame> frame_;
};

using Table = std::vector<std::vector<std::string>>;

std::vector<std::vector<std::string>> compare(ExperimentContext& context, std::span<const ToolArgument> arguments) {
    const Call call = callOf(arguments);
    const PrecisionFolder folder(call.folder);
    Car car(context);
    Table table{{"problem", "cells", "scheme", "ms per second", "cells per step", "divergence per step"}};
    const auto run = [&](std::string_view problem, int cells, const GridProblem& set, Scheme scheme) {
        const std::string_view word = schemes.wordOf(scheme);
        const SolvedProblem solved = solve(set, ruleOf(scheme));
        folder.addRun(problem, cells, word, solved);
        table.push_back({std::string(problem), std::to_string(cells), std::string(word),
                         fmt::format("{:.1f}", 1000 * solved.computingSeconds / set.seconds()),
                         fmt::format("{:.2f}", solved.cellsPerStep), fmt::format("{:.1e}", solved.divergencePerStep)});
    };
    for (const ProblemKind kind : call.problems) {
        const std::string_view problem = problemKinds.wordOf(kind);
        const auto setOn = [&](int cells) {
            GridProblem set = problemOn(kind, cells, std::ref(car));
            folder.writeSetUp(problem, cells, set);
            return set;
        };
        for (const int cells : call.cells) {
            const GridProblem set = setOn(cells);
            for (int repetition = 0; repetition < call.repetitions; ++repetition)
                for (const Scheme scheme : call.schemes) run(problem, cells, set, scheme);
        }
        if (call.referenceCells > 0 && !folder.hasFlow(problem, call.referenceCells, "revert"))
            run(problem, call.referenceCells, setOn(call.referenceCells), Scheme::revert);
    }
    if (call.referenceCells > 0) (void)folder.writePoints(call.referenceCells);
    return table;
}

}  // namespace

ToolInfo describe() {
    ToolInfo info;
    info.summary = "Compare fluid solvers by error and time on three problems";
    info.manual =
        "Solves the problems on each grid with each scheme, and on the reference grid with `revert` unless that flow\n"
        "exists. `revert_midstep` is `revert` with the velocity at the middle of the step. Then compares all flows in\n"
        "the folder, including those of other solvers, and writes points.csv. Formats: "
        "methods/grid_fluid/precision/precision_folder.h, staggered_flow.h.\n"
        "Example: dustbench precision out/precision --cells 16,32";
    info.options = {
        {"folder", "DIR", "folder for the flows, times.csv and points.csv; created if missing"},
        {"--problem", "LIST", "problems to solve: plume, ring, car, or `nothing`; default: all"},
        {"--cells", "LIST", "cells across the box, multiples of 8; default: 16,32,64"},
        {"--scheme", "LIST", "schemes: revert_midstep, revert, clamp, unlimited, semi_lagrangian; default: all"},
        {"--reference", "CELLS",
         "cells across the reference grid; a solver's finest flow is a reference if it has as many; 0: compares none; "
         "default: 128"},
        {"--repetitions", "N", "number of times each problem is solved, for its time; default: 1"}};
    info.run = compare;
    return info;
}

}  // namespace dustbench::grid_fluid::precision
