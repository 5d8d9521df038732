#include "bench/results/input_files.h"

#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/matching_files.h"

namespace dustbench::results {

std::vector<std::filesystem::path> dataFilesOf(const ParameterValues& parameters) {
    std::vector<std::filesystem::path> files;
    for (const Parameter& each : parameters.declared().all())
        if (!each.fileExtension.empty())
            for (std::filesystem::path& file : files::matchingFiles(
                     files::findData(each.name, each.dataFolder, parameters.choice(each.name), each.fileExtension)))
                files.push_back(std::move(file));
    return files;
}

void recordInputs(const world::World& world, const ParameterValues& ofMethod, const files::InputLog& read,
                  measure::Provenance& provenance) {
    std::vector<std::filesystem::path> all = world.inputFiles();
    for (std::filesystem::path& file : dataFilesOf(ofMethod)) all.push_back(std::move(file));
    for (std::filesystem::path& file : read.files()) all.push_back(std::move(file));
    provenance.inputs = measure::hashInputs(all);
    provenance.ignored = measure::ignoredParts(read.ignored());
    provenance.searches = measure::hashSearches(read.searches());
}

}  // namespace dustbench::results
