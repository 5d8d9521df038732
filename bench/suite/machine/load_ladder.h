// Orders the runs of a machine's measurement, and leaves out those that would take too much time or memory.
//
// Cells that differ only in their load and in the size of their picture form a ladder. The lowest load of every ladder
// comes first, at all sizes, then the next one, so that a limit leaves out the highest loads. Once every cell has run
// or was left out, the cells that ran are repeated in the same order, as long as time remains.
//
// A run is predicted from the next lower load at the same size, and from the same load at the next smaller size: what
// it takes beyond the least of its suite is assumed to grow with the load, or with the number of pixels. Where the
// comparison of its pictures alone takes too long, the first run is left out and the second, which has none, comes at
// once.
//
// Units: seconds, bytes. Threads: plain data.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace dustbench::suite {

struct LadderCell {
    std::string suite;
    std::string ladder;  ///< within the suite
    double load = 1;
    double pixels = 1;
    int repetitions = 1;
    bool evaluated = false;  ///< its first run's pictures are compared with a reference
};

/// What a run takes.
struct RunNeeds {
    double seconds = 0;        ///< from the start of its process to the last frame
    double metricSeconds = 0;  ///< the comparison of its pictures after it
    double hostBytes = 0;
    double deviceBytes = 0;

    [[nodiscard]] double allSeconds() const { return seconds + metricSeconds; }
};

struct LadderLimits {
    double totalSeconds = 0;   ///< of all runs
    double runSeconds = 0;     ///< RunNeeds::seconds of one run
    double metricSeconds = 0;  ///< RunNeeds::metricSeconds of one run
    double hostBytes = std::numeric_limits<double>::infinity();
    double deviceBytes = std::numeric_limits<double>::infinity();
};

struct LadderStep {
    std::size_t cell = 0;
    int repetition = 1;
    std::string skip{};  ///< why the cell is left out; empty: it is to run
};

class LoadLadder {
 public:
    LoadLadder(std::vector<LadderCell> cells, LadderLimits limits);

    /// The next run, or cell to leave out; empty at the end. Each run is to be answered by `done` or `failed` before
    /// the next call. `elapsedSeconds` counts from the start of the measurement.
    [[nodiscard]] std::optional<LadderStep> next(double elapsedSeconds);
    void done(const LadderStep& step, const RunNeeds& needs);
    void failed(const LadderStep& step);

    /// Repetitions that the total limit left out.
    [[nodiscard]] std::size_t repetitionsLeftOut() const { return repetitionsLeftOut_; }
    /// Empty if nothing below or beside the cell is done.
    [[nodiscard]] std::optional<RunNeeds> predicted(std::size_t cell) const;

 private:
    enum class State { open, done, failed, leftOut, notEvaluated };
    using Place = std::tuple<std::string, std::string, double, double>;  ///< suite, ladder, pixels, load

    struct Basis {
        std::size_t cell;
        double growth;
    };

    [[nodiscard]] std::vector<Basis> basesOf(std::size_t cell) const;
    [[nodiscard]] std::optional<std::size_t> below(std::size_t cell) const;
    [[nodiscard]] std::optional<std::size_t> smaller(std::size_t cell) const;
    [[nodiscard]] RunNeeds leastOf(std::size_t cell, bool atItsSize) const;
    [[nodiscard]] double metricSeconds(std::size_t cell) const;
    [[nodiscard]] std::string whyNotMeasured(std::size_t cell, double elapsedSeconds) const;
    [[nodiscard]] std::string whyNotEvaluated(std::size_t cell, double elapsedSeconds) const;
    void repeatNow(std::size_t cell);
    void sortSteps();

    std::vector<LadderCell> cells_;
    LadderLimits limits_;
    std::vector<State> states_;
    std::vector<RunNeeds> needs_;
    std::map<Place, std::size_t> places_;
    std::vector<std::pair<std::size_t, int>> steps_;  ///< cell and repetition
    std::size_t next_ = 0;
    std::size_t repetitionsLeftOut_ = 0;
};

}  // namespace dustbench::suite
