#include "methods/kit/files/input_log.h"

#include <gtest/gtest.h>

#include <fstream>

#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::files {
namespace {

namespace fs = std::filesystem;

TEST(InputLog, NotesEachFileOnceThatIsReadWhileItLives) {
    const TestFolder place;
    const fs::path& folder = place.path();
    fs::create_directories(folder / "deep");
    std::ofstream(folder / "a.toml") << "x = 1\n";
    std::ofstream(folder / "b.csv") << "x\n1\n";
    std::ofstream(folder / "deep" / "c.toml") << "";
    (void)TomlReader::parseFile(folder / "deep" / "c.toml");  // before
    {
        const InputLog log;
        EXPECT_TRUE(log.files().empty());
        (void)CsvTable::parseFile(folder / "b.csv");
        (void)TomlReader::parseFile(folder / "a.toml");
        (void)findData("thing", "things", (folder / "deep" / ".." / "a.toml").string(), ".toml");
        EXPECT_EQ(log.files(), (std::vector{folder / "a.toml", folder / "b.csv"}));
        EXPECT_THROW(InputLog(), std::logic_error);
    }
    (void)TomlReader::parseFile(folder / "a.toml");
    EXPECT_TRUE(InputLog().files().empty());
}

TEST(InputLog, NamesThatAreNotUtf8AreRefusedAsSuch) {
    for (const char* name : {"lat\xe9.vti", "a\xff", "cut\xc3"})
        EXPECT_NE(inputError([&] { noteInput(name); }).find("the file's name is not UTF-8"), std::string::npos);
    EXPECT_NO_THROW(noteInput("l\xc3\xa4t\xe2\x82\xac.vti"));
}

}  // namespace
}  // namespace dustbench::files
