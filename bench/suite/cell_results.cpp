#include "bench/suite/cell_results.h"

#include "methods/kit/files/csv.h"

namespace dustbench::bench {

const StoredRun* doneRun(const PlannedRun& cell, int repetition, const StoredRuns& runs) {
    const auto found = runs.find(runId(inRepetition(cell.spec, repetition)));
    return found != runs.end() && found->second.status == RunStatus::done ? &found->second : nullptr;
}

std::vector<const StoredRun*> doneRuns(const PlannedRun& cell, int repetitions, const StoredRuns& runs) {
    std::vector<const StoredRun*> done;
    for (int repetition = 1; repetition <= repetitions; ++repetition)
        if (const StoredRun* run = doneRun(cell, repetition, runs)) done.push_back(run);
    return done;
}

const StoredRun* validRun(const PlannedRun& cell, int repetition, const StoredRuns& runs) {
    const StoredRun* run = doneRun(cell, repetition, runs);
    return run && whyInvalid(*run).empty() ? run : nullptr;
}

std::vector<const StoredRun*> validOf(std::vector<const StoredRun*> done) {
    std::erase_if(done, [](const StoredRun* run) { return !whyInvalid(*run).empty(); });
    return done;
}

std::optional<double> numberIn(const StoredRun& run, std::string_view column) {
    const auto found = run.cells.find(column);
    return found == run.cells.end() ? std::nullopt : files::numberOf(found->second);
}

std::vector<double> numbersIn(const std::vector<const StoredRun*>& runs, std::string_view column) {
    std::vector<double> numbers;
    for (const StoredRun* run : runs)
        if (const auto number = numberIn(*run, column)) numbers.push_back(*number);
    return numbers;
}

}  // namespace dustbench::bench
