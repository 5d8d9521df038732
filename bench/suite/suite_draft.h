// What a suite's file says, before anything is multiplied out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/suite/suite.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {

/// An `[[except]]` table: cells that have one of the values of every list that is not empty are left out.
struct Exception {
    std::vector<std::string> methods, scenes, drives, sizes;
    ParameterLists parameters;
    int afterRepetition = 0;  ///< those up to this one are not left out
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
    std::map<std::string, ParameterTexts> finerSettings;  ///< by method: what it is judged against
    std::vector<Exception> exceptions;

    /// Reads a table over what is there: a whole file, or its `[quick]`. Throws InputError with file and line.
    void read(files::TomlReader& table);
};

/// Puts the values of a parameter into its place, or at the end.
void setList(ParameterLists& lists, const std::string& name, std::vector<std::string> values);

}  // namespace dustbench::bench
