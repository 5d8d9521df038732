#include "bench/suite/machine/load_ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>

#include "bench/results/output_files.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::suite {
namespace {

constexpr std::uint64_t orderSeed = 1;

std::string secondsText(double seconds) {
    return fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0);
}

std::string sizeText(double bytes) {
    return results::bytesText(static_cast<std::uint64_t>(bytes));
}

/// Beyond the least, in proportion.
double grown(double value, double least, double growth) {
    return least + std::max(value - least, 0.0) * growth;
}

RunNeeds lower(const RunNeeds& a, const RunNeeds& b) {
    return {.seconds = std::min(a.seconds, b.seconds),
            .metricSeconds = std::min(a.metricSeconds, b.metricSeconds),
            .hostBytes = std::min(a.hostBytes, b.hostBytes),
            .deviceBytes = std::min(a.deviceBytes, b.deviceBytes)};
}

}  // namespace

LoadLadder::LoadLadder(std::vector<LadderCell> cells, LadderLimits limits)
    : cells_(std::move(cells)), limits_(limits), states_(cells_.size(), State::open), needs_(cells_.size()) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const LadderCell& cell = cells_[i];
        places_.emplace(Place(cell.suite, cell.ladder, cell.pixels, cell.load), i);
    }
    sortSteps();
}

/// By repetition, rung, size and suite. Within these the methods of one world follow each other in random order,
/// another in every repetition, so that drift of the machine affects all alike.
void LoadLadder::sortSteps() {
    std::map<std::pair<std::string, std::string>, std::set<double>> loads;
    std::map<std::string, std::size_t> suites;  // in order of appearance
    for (const LadderCell& cell : cells_) {
        loads[{cell.suite, cell.ladder}].insert(cell.load);
        suites.emplace(cell.suite, suites.size());
    }
    using Key = std::tuple<int, std::ptrdiff_t, double, std::size_t, std::uint32_t>;
    std::map<std::pair<std::size_t, int>, Key> keys;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const LadderCell& cell = cells_[i];
        const std::set<double>& rungs = loads.at({cell.suite, cell.ladder});
        const auto rung = std::distance(rungs.begin(), rungs.find(cell.load));
        for (int repetition = 1; repetition <= cell.repetitions; ++repetition) {
            const auto random = maths::randomWords(orderSeed, static_cast<std::uint32_t>(repetition), i)[0];
            keys[{i, repetition}] = {repetition, rung, cell.pixels, suites.at(cell.suite), random};
        }
    }
    for (const auto& [step, key] : keys) steps_.push_back(step);
    std::ranges::sort(steps_, {}, [&](const auto& step) { return std::pair(keys.at(step), step); });
}

std::optional<LadderStep> LoadLadder::next(double elapsedSeconds) {
    while (next_ < steps_.size()) {
        const auto [cell, repetition] = steps_[next_++];
        LadderStep step{cell, repetition, {}};
        if (repetition == 1) {
            step.skip = whyNotMeasured(cell, elapsedSeconds);
            if (!step.skip.empty()) {
                states_[cell] = State::leftOut;
            } else if (step.skip = whyNotEvaluated(cell, elapsedSeconds); !step.skip.empty()) {
                states_[cell] = State::notEvaluated;
                repeatNow(cell);
            }
            return step;
        }
        if (states_[cell] == State::notEvaluated) return step;
        if (states_[cell] != State::done) continue;
        if (elapsedSeconds + needs_[cell].seconds <= limits_.totalSeconds) return step;
        ++repetitionsLeftOut_;
    }
    return std::nullopt;
}

/// The second run comes next.
void LoadLadder::repeatNow(std::size_t cell) {
    const auto begin = steps_.begin() + static_cast<std::ptrdiff_t>(next_);
    const auto second = std::find(begin, steps_.end(), std::pair(cell, 2));
    if (second != steps_.end()) std::rotate(begin, second, std::next(second));
}

void LoadLadder::done(const LadderStep& step, const RunNeeds& needs) {
    if (step.repetition > 1 && states_[step.cell] != State::notEvaluated) return;
    states_[step.cell] = State::done;
    needs_[step.cell] = needs;
}

void LoadLadder::failed(const LadderStep& step) {
    if (step.repetition == 1 || states_[step.cell] == State::notEvaluated) states_[step.cell] = State::failed;
}

/// The next lower load at the same size whose pictures were not the only reason to leave it out.
std::optional<std::size_t> LoadLadder::below(std::size_t cell) const {
    const LadderCell& of = cells_[cell];
    for (auto at = places_.find(Place(of.suite, of.ladder, of.pixels, of.load)); at != places_.begin();) {
        const LadderCell& other = cells_[(--at)->second];
        if (other.suite != of.suite || other.ladder != of.ladder || other.pixels != of.pixels) return std::nullopt;
        if (states_[at->second] != State::notEvaluated) return at->second;
    }
    return std::nullopt;
}

/// The same load at the next smaller size.
std::optional<std::size_t> LoadLadder::smaller(std::size_t cell) const {
    const LadderCell& of = cells_[cell];
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const LadderCell& other = cells_[i];
        if (other.suite != of.suite || other.ladder != of.ladder || other.load != of.load || other.pixels >= of.pixels)
            continue;
        if (!found || other.pixels > cells_[*found].pixels) found = i;
    }
    return found;
}

std::vector<LoadLadder::Basis> LoadLadder::basesOf(std::size_t cell) const {
    std::vector<Basis> bases;
    const auto add = [&](const std::optional<std::size_t>& basis, double growth) {
        if (basis && states_[*basis] == State::done) bases.push_back({*basis, growth});
    };
    if (const auto lower = below(cell)) add(lower, cells_[cell].load / cells_[*lower].load);
    if (const auto less = smaller(cell)) add(less, cells_[cell].pixels / cells_[*less].pixels);
    return bases;
}

/// What the suite's smallest runs took: start, libraries and the opaque scene, which do not grow.
RunNeeds LoadLadder::leastOf(std::size_t cell, bool atItsSize) const {
    std::optional<RunNeeds> least;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        if (states_[i] != State::done || cells_[i].suite != cells_[cell].suite) continue;
        if (atItsSize && cells_[i].pixels != cells_[cell].pixels) continue;
        least = least ? lower(*least, needs_[i]) : needs_[i];
    }
    return least.value_or(RunNeeds());
}

/// The reference takes the same for every method; from a lower load it grows with the load.
double LoadLadder::metricSeconds(std::size_t cell) const {
    const LadderCell& of = cells_[cell];
    if (!of.evaluated) return 0;
    double longest = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (states_[i] == State::done && cells_[i].evaluated && cells_[i].suite == of.suite &&
            cells_[i].load == of.load && cells_[i].pixels == of.pixels)
            longest = std::max(longest, needs_[i].metricSeconds);
    if (longest > 0) return longest;
    const auto lower = below(cell);
    if (!lower || states_[*lower] != State::done) return 0;
    return needs_[*lower].metricSeconds * of.load / cells_[*lower].load;
}

std::optional<RunNeeds> LoadLadder::predicted(std::size_t cell) const {
    std::optional<RunNeeds> prediction;
    for (const Basis& basis : basesOf(cell)) {
        const RunNeeds& known = needs_[basis.cell];
        const RunNeeds least = leastOf(basis.cell, cells_[basis.cell].pixels == cells_[cell].pixels);
        const RunNeeds each{.seconds = grown(known.seconds, least.seconds, basis.growth),
                            .metricSeconds = 0,
                            .hostBytes = grown(known.hostBytes, least.hostBytes, basis.growth),
                            .deviceBytes = grown(known.deviceBytes, least.deviceBytes, basis.growth)};
        prediction = prediction ? lower(*prediction, each) : each;
    }
    if (prediction) prediction->metricSeconds = metricSeconds(cell);
    return prediction;
}

std::string LoadLadder::whyNotMeasured(std::size_t cell, double elapsedSeconds) const {
    if (const auto lower = below(cell)) {
        const double load = cells_[*lower].load;
        if (states_[*lower] == State::failed) return fmt::format("the lower load {:.10g} failed", load);
        if (states_[*lower] == State::leftOut) return fmt::format("the lower load {:.10g} was left out", load);
    }
    if (const auto less = smaller(cell); less && states_[*less] == State::failed) return "a smaller picture failed";

    const RunNeeds needs = predicted(cell).value_or(RunNeeds());
    const std::string about = "would take about " + secondsText(needs.seconds);
    if (needs.seconds > limits_.runSeconds)
        return fmt::format("{}, allowed: {} for one run", about, secondsText(limits_.runSeconds));
    if (needs.hostBytes > limits_.hostBytes)
        return fmt::format("would need about {} of memory, allowed: {}", sizeText(needs.hostBytes),
                           sizeText(limits_.hostBytes));
    if (needs.deviceBytes > limits_.deviceBytes)
        return fmt::format("would need about {} of GPU memory, allowed: {}", sizeText(needs.deviceBytes),
                           sizeText(limits_.deviceBytes));
    const double left = limits_.totalSeconds - elapsedSeconds;
    if (left <= 0) return fmt::format("the limit of {} for all runs is reached", secondsText(limits_.totalSeconds));
    if (needs.seconds > left)
        return fmt::format("{}, but {} of {} for all runs are left", about, secondsText(left),
                           secondsText(limits_.totalSeconds));
    return "";
}

std::string LoadLadder::whyNotEvaluated(std::size_t cell, double elapsedSeconds) const {
    const double needed = metricSeconds(cell);
    const double left = limits_.totalSeconds - elapsedSeconds - predicted(cell).value_or(RunNeeds()).seconds;
    const std::string about = "comparing its pictures would take about " + secondsText(needed);
    if (needed > limits_.metricSeconds) return about + ", allowed: " + secondsText(limits_.metricSeconds);
    if (needed > left) return about + ", but " + secondsText(left) + " are left";
    return "";
}

}  // namespace dustbench::suite
