// The contents of a suite file before its combinations are expanded.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/suite/suite.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::suite {

/// An `[[except]]` table: excludes configurations that match one value of every non-empty list.
struct Exception {
    std::vector<std::string> methods, scenes, drives, sizes;
    ParameterLists parameters;
    int afterRepetition = 0;   ///< repetitions up to this one are kept
    std::string reason;        ///< recorded with the skipped runs; empty: they do not appear
    bool metricsOnly = false;  ///< the runs stay, but their pictures are not compared
    std::string where;         ///< `file:line: `, for messages
};

struct SuiteDraft {
    std::filesystem::path file;  ///< the file being read; empty: none, paths stay as given
    std::vector<std::string> methods{"all"};
    std::vector<std::string> scenes{"plain"};
    std::vector<std::string> drives{""};
    std::vector<std::string> sizes{"640x480"};
    std::vector<std::uint64_t> seeds{1};
    results::RunSpec base;
    Suite suite;
    ParameterLists parameters;
    std::vector<std::pair<std::string, ParameterLists>> methodParameters;
    std::map<std::string, results::ParameterTexts> finerSettings;  ///< by method: settings of its reference
    std::vector<Exception> exceptions;
    std::string chartWhere;        ///< `file:line: ` of `chart`, for messages
    std::string timesWhere;        ///< the same for `times`
    std::optional<bool> baseline;  ///< empty: if times are compared, fitted or repeated

    /// Reads a table over the current values: a whole file, or its `[quick]`. Throws InputError with file and
    /// line.
    void read(files::TomlReader& table);
};

/// Replaces the values of a parameter, or appends it.
void setList(ParameterLists& lists, const std::string& name, std::vector<std::string> values);

}  // namespace dustbench::suite
