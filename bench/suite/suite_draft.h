// The contents of a suite file, before the combinations are expanded.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/suite/suite.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {

/// An `[[except]]` table: excludes cells that match one value of every non-empty list.
struct Exception {
    std::vector<std::string> methods, scenes, drives, sizes;
    ParameterLists parameters;
    int afterRepetition = 0;  ///< repetitions up to this one are kept
    std::string reason;       ///< recorded with the cells, as skipped; empty: they do not appear
    bool metricsOnly = false;  ///< the cells run, but their pictures are not compared
    std::string where;        ///< `file:line: `, for messages
};

struct SuiteDraft {
    std::filesystem::path file;  ///< that is read; empty: none, paths are as they are
    std::vector<std::string> methods{"all"};
    std::vector<std::string> scenes{"plain"};
    std::vector<std::string> drives{""};
    std::vector<std::string> sizes{"640x480"};
    std::vector<std::uint64_t> seeds{1};
    RunSpec base;
    Suite suite;
    ParameterLists parameters;
    std::vector<std::pair<std::string, ParameterLists>> methodParameters;
    std::map<std::string, ParameterTexts> finerSettings;  ///< by method: the settings of its reference
    std::vector<Exception> exceptions;
    std::string chartWhere;        ///< `file:line: ` of `chart`, for messages
    std::string timesWhere;        ///< the same of `times`
    std::optional<bool> baseline;  ///< empty: where times are compared, fitted or repeated

    /// Reads a table on top of the present values: a whole file, or its `[quick]`. Throws InputError with file and
    /// line.
    void read(files::TomlReader& table);
};

/// Replaces the values of a parameter, or appends it.
void setList(ParameterLists& lists, const std::string& name, std::vector<std::string> values);

}  // namespace dustbench::bench
