#include "bench/suite/paper.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::suite {
namespace fs = std::filesystem;

fs::path paperFile(const std::string& id, const std::string& name) {
    const fs::path folder = files::dataPath(fs::path("papers") / id);
    return !folder.empty() && fs::exists(folder / name) ? folder / name : fs::path();
}

std::vector<std::string> listPapers() {
    std::vector<std::string> ids = files::listDataFolders("papers");
    std::erase_if(ids, [](const std::string& id) { return paperFile(id, "paper.toml").empty(); });
    return ids;
}

std::vector<std::string> experimentNames() {
    std::vector<std::string> names;
    for (const ExperimentInfo& info : experiments()) names.push_back(info.id);
    return names;
}

Paper loadPaper(const std::string& id) {
    const std::vector<std::string> known = listPapers();
    if (std::ranges::find(known, id) == known.end()) throw unknownName("paper", id, known);
    files::TomlReader file = files::TomlReader::parseFile(paperFile(id, "paper.toml"));
    Paper paper;
    paper.id = id;
    if (const std::string named = file.text("id"); named != id)
        throw InputError(file.where("id") + "key 'id': got '" + named + "', expected the folder's name '" + id + "'");
    paper.title = file.text("title");
    paper.authors = file.text("authors");
    if (file.has("year")) paper.year = file.integer("year", 1800, 2200);
    paper.venue = file.text("venue");
    paper.key = file.text("key");
    paper.summary = file.text("summary");
    paper.suites = file.texts("suites");
    if (file.has("experiments")) paper.experiments = file.texts("experiments");
    const std::vector<std::string> experimentsKnown = experimentNames();
    for (const std::string& name : paper.experiments)
        if (std::ranges::find(experimentsKnown, name) == experimentsKnown.end())
            throw InputError(file.where("experiments") + unknownName("experiment", name, experimentsKnown).what());
    if (file.has("controls")) paper.controls = file.texts("controls");
    file.finish();
    return paper;
}

}  // namespace dustbench::suite
