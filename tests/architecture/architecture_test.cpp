// Checks the project's rules in every file of the tree.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "source_folder.h"
#include "tests/architecture/source_rules.h"

namespace dustbench::architecture {
namespace {

const std::filesystem::path root = DUSTBENCH_SOURCE_DIR;

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Files below a folder of the tree, as paths from the root, sorted.
std::vector<std::string> filesBelow(const std::string& folder) {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
        if (entry.is_regular_file()) paths.push_back(entry.path().lexically_relative(root).generic_string());
    }
    std::ranges::sort(paths);
    return paths;
}

const std::vector<SourceFile>& sources() {
    static const std::vector<SourceFile> all = [] {
        std::vector<SourceFile> files;
        for (const std::string folder : {"methods", "bench", "tests"}) {
            for (const std::string& path : filesBelow(folder)) {
                static const std::set<std::string> kinds{".h", ".cpp", ".vert", ".frag", ".comp", ".glsl"};
                if (kinds.contains(std::filesystem::path(path).extension()))
                    files.push_back({path, textOf(root / path)});
            }
        }
        return files;
    }();
    return all;
}

/// The faults of all files, one per line; empty if there are none.
std::string faultsOfAll(const std::function<Faults(const SourceFile&)>& rule) {
    std::string all;
    for (const SourceFile& file : sources()) {
        for (const std::string& fault : rule(file)) all += fault + "\n";
    }
    return all;
}

}  // namespace

TEST(Architecture, HasItsSourcesWhereTheTestLooks) {
    EXPECT_GE(sources().size(), 50u);
}

TEST(Architecture, IncludesPointOneWay) {
    EXPECT_EQ(faultsOfAll(includeFaults), "");
}

TEST(Architecture, EachModuleOfTheHarnessHasItsNamespace) {
    EXPECT_EQ(faultsOfAll(namespaceFaults), "");
}

TEST(Architecture, TheContractIsAShortReadAndNeedsNothingOfOurs) {
    EXPECT_EQ(faultsOfAll(contractFaults), "");
    const auto isHeader = [](const SourceFile& file) {
        return file.path.starts_with("methods/contract/") && file.path.ends_with(".h");
    };
    EXPECT_LE(std::ranges::count_if(sources(), isHeader), 15);
}

TEST(Architecture, EveryFolderOfTheKitHasTwoUsers) {
    // The interface for external methods.
    const std::set<std::string> exceptions{"library"};
    for (const auto& [folder, users] : kitUsers(sources())) {
        if (exceptions.contains(folder)) continue;
        EXPECT_GE(users.size(), 2u) << "methods/kit/" << folder << ": code of a single method belongs in the method";
    }
}

TEST(Architecture, OpenGlStaysInTheGpuLayer) {
    EXPECT_EQ(faultsOfAll(openGlFaults), "");
}

TEST(Architecture, FilesAreShortOrSayWhyNot) {
    EXPECT_EQ(faultsOfAll(lengthFaults), "");
}

TEST(Architecture, HeadersSayWhatTheyAreFor) {
    EXPECT_EQ(faultsOfAll(purposeFaults), "");
}

TEST(Architecture, FilesOfAModuleShareNoNamesThatTheyKeepToThemselves) {
    std::string all;
    for (const std::string& fault : sharedNameFaults(sources())) all += fault + "\n";
    EXPECT_EQ(all, "");
}

TEST(Architecture, EveryCitationIsInTheBibliography) {
    const auto keys = bibliographyKeys(textOf(root / "data/references.bib"));
    EXPECT_FALSE(keys.empty());
    // The checker's own tests cite keys that do not exist.
    const auto rule = [&keys](const SourceFile& file) {
        return file.path.starts_with("tests/architecture/") ? Faults{} : citationFaults(file, keys);
    };
    EXPECT_EQ(faultsOfAll(rule), "");
}

TEST(Architecture, EveryDataFileHasItsOriginInTheReadme) {
    const auto names = quotedNames(textOf(root / "data/README.md"));
    std::string unnamed;
    for (const std::string& path : filesBelow("data")) {
        const std::string name = path.substr(std::string("data/").size());
        if (name != "README.md" && !isNamed(name, names)) unnamed += name + "\n";
    }
    EXPECT_EQ(unnamed, "");
}

}  // namespace dustbench::architecture
