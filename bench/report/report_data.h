// The data of a results folder's report, passed from the readers to the writers.
//
// Units: as the columns of summary.csv. Threads: plain data.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "bench/measure/cost_fit.h"
#include "bench/report/median_interval.h"
#include "bench/results/stored_run.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite_evaluation.h"

namespace dustbench::report {

/// A parameter or setting that varies between the configurations of an experiment.
struct ReportAxis {
    std::string name;  ///< `particles`, `scene`, `size`
    std::string unit;
    std::string help;
    bool world = false;               ///< part of the world, not a method's own setting
    bool numeric = false;             ///< every value is a number
    std::vector<std::string> values;  ///< ascending
};

/// All runs of one configuration on one machine. They differ only in the repetition.
struct ReportCell {
    std::string method;
    std::map<std::string, std::string, std::less<>> settings;  ///< by axis, if the method has it
    std::size_t machine = 0;
    std::vector<const results::StoredRun*> done;  ///< by repetition
    std::size_t failed = 0;
    std::map<std::string, MedianInterval, std::less<>> values;  ///< by column of summary.csv
};

/// A fit ms = a + b·N^k of the runs of cells that differ only in the load N.
struct ReportFit {
    std::string axis, column, method;
    std::map<std::string, std::string, std::less<>> settings;  ///< without that of `axis`
    std::size_t machine = 0;
    measure::CostFit fit;
};

/// A number stated in a paper's text.
struct PublishedPoint {
    claims::Selection of;  ///< the series it belongs to
    std::string axis;      ///< with x; empty: the paper states no load
    double x = 0;
    std::string column;
    double minimum = 0, maximum = 0;
    std::string hardware;  ///< and its year
    std::string what;      ///< description
    /// Its series within a group of runs: the method, and the values of axes that `of` names.
    std::string method{};
    std::map<std::string, std::string, std::less<>> settings{};
};

struct RunGroup {
    std::string id;  ///< id of its suite, with `-quick` for the quick run; or `other`
    std::string suite, title, summary, paper;
    std::string suiteText;   ///< the suite's file
    suite::ChartView chart;  ///< initial view of its chart
    /// Settings of the world that all runs share: `size`, `frames`, `speed`.
    std::map<std::string, std::string, std::less<>> common;
    std::vector<suite::ComparisonResult> comparisons;
    std::vector<ReportAxis> axes;
    std::vector<ReportCell> cells;
    std::vector<ReportFit> fits;
    std::vector<PublishedPoint> published;
    std::optional<double> budgetMs;  ///< a line at this time in the chart of quality against `method_ms_median`
};

/// Frame times of one run: all as a histogram, a selection as a trace.
struct FrameTimes {
    std::string runId, group, label;
    std::size_t frames = 0;
    double minimumMs = 0, binMs = 0;
    std::vector<int> bins;
    /// The minimum and the maximum of each stretch of frames, in order, so that no spike is lost.
    std::vector<std::pair<std::size_t, double>> trace;
};

/// Metrics of a picture by column of metrics.csv: `psnr_db`, `ssim`, `flip`.
using PictureNumbers = std::map<std::string, double, std::less<>>;

/// One picture of a run, as shown on the page.
struct ReportPicture {
    std::string label;   ///< `billboard soft=on`, `exact`
    std::string method;  ///< empty for the ground truth
    bool difference = false;
    std::string source;  ///< data URL, or path relative to the page
    PictureNumbers numbers;
};

/// All pictures of one world at one frame.
struct PictureSet {
    std::string group, world;
    int frame = 0;
    int width = 0, height = 0;
    std::vector<ReportPicture> pictures;
};

struct NotDone {
    std::string runId, status, reason;
};

/// Warnings of one kind, which differ only in their numbers.
struct RunWarnings {
    std::string warning;  ///< the first one
    std::vector<std::string> runs;
};

/// Move, do not copy: experiments contain pointers into `runs`.
struct ReportData {
    std::string folder;       ///< its name, for the title
    std::string root;         ///< of links, relative to the page: empty, or ending in '/'
    bool tablesOnly = false;  ///< the folder contains tables but no runs
    std::string writtenUtc;   ///< ISO 8601
    results::StoredRuns runs;
    std::vector<std::string> problems;  ///< missing or doubtful data, one sentence each
    /// The problems that report different machines or builds.
    std::vector<std::string> mixedMachines;
    /// Provenance fields of each machine involved.
    std::vector<std::map<std::string, std::string, std::less<>>> machines;
    std::vector<suite::Paper> papers;
    std::vector<std::string> files;  ///< raw files in the folder, relative to it
    std::vector<RunGroup> groups;
    std::vector<claims::EvaluatedClaim> claims;
    std::vector<FrameTimes> frameTimes;
    std::size_t runsWithoutFrameTimes = 0;  ///< omitted, to keep the page small
    std::vector<PictureSet> pictureSets;
    std::size_t linkedPictures = 0;  ///< linked instead of embedded
    std::vector<NotDone> notDone;
    std::vector<RunWarnings> warnings;
};

}  // namespace dustbench::report
