// The record of one run, as written to run.json, and the specification that a run's process reads.
//
// The JSON library is used in one source file only. stored_run.h reads what is written here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bench/measure/provenance.h"
#include "bench/results/output_files.h"
#include "bench/results/run_spec.h"
#include "methods/kit/gpu/adapter.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::results {

enum class RunStatus { done, failed, timeout, skipped };
inline constexpr Choices<RunStatus> runStatuses{{"done", RunStatus::done},
                                                {"failed", RunStatus::failed},
                                                {"timeout", RunStatus::timeout},
                                                {"skipped", RunStatus::skipped}};

/// A value of summary.csv. Missing and non-finite values are empty in CSV and null in JSON.
using Value = std::variant<std::monostate, std::int64_t, double, std::string>;
/// Text in a CSV file, before quoting.
[[nodiscard]] std::string valueText(const Value& value);

using Columns = std::vector<std::pair<std::string, Value>>;

struct RunRecord {
    RunSpec spec;
    RunStatus status = RunStatus::done;
    std::string reason;                 ///< why it is not done; empty if it is
    std::string drive;                  ///< the resolved one
    std::string stateHash;              ///< 16 hexadecimal digits, of vehicle and shared dust after the last frame
    std::string methodHash;             ///< of the method's own simulation; empty if it has none
    std::vector<std::string> validity;  ///< why claims must not use it (method_facts.h); empty if valid
    Columns summary;                    ///< columns of summary.csv, without parameters
    std::vector<std::pair<std::string, MemoryUse>> memory;  ///< owner (`world`, `method`, `device`) and structure
    std::optional<std::vector<OutputFile>> outputs;         ///< files in the same folder; empty: unknown
    measure::Provenance provenance;
};

/// run.json as text.
[[nodiscard]] std::string toJson(const RunRecord& record);

/// The record of an export, written to the folder of its files.
struct ExportRecord {
    struct Moment {
        std::int64_t frame;
        double timeSeconds;
        std::string stateHash;
    };
    RunSpec spec;
    std::string drive;  ///< the resolved one
    std::vector<Moment> moments;
    std::vector<std::string> series;  ///< names of the series files
    measure::Provenance provenance;
};
/// export.json as text.
[[nodiscard]] std::string toJson(const ExportRecord& record);

[[nodiscard]] std::string specToJson(const RunSpec& spec);
/// Throws InputError.
[[nodiscard]] RunSpec specFromJson(std::string_view text);

struct ListedItem {
    Columns cells;
    std::vector<Parameter> parameters;
    bool withParameters = false;
};
/// For `--json`: an array of objects with the items' values in order, and `parameters` if requested.
[[nodiscard]] std::string listToJson(const std::vector<ListedItem>& items);
/// One object with the provenance fields of a run, followed by the machine's adapters and `more`.
[[nodiscard]] std::string provenanceToJson(const measure::Provenance& provenance,
                                           std::span<const gpu::Adapter> adapters, const Columns& more);

}  // namespace dustbench::results
