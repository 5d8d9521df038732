#include "methods/kit/files/whole_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "methods/kit/files/csv.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::files {
namespace {

using ::testing::HasSubstr;

/// The different ways to read a text.
std::vector<std::string> refusals(const std::filesystem::path& file) {
    return {inputError([&] { (void)wholeText(file, "a text"); }), inputError([&] { (void)CsvTable::parseFile(file); }),
            inputError([&] { (void)TomlReader::parseFile(file); })};
}

TEST(WholeText, TakesRegularFilesAlone) {
    const TestFolder folder;
    ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("loop", folder.path() / "loop");
    std::filesystem::create_symlink("/dev/zero", folder.path() / "zero");
    const std::vector<std::pair<const char*, const char*>> expected{
        {"pipe", "is a pipe, allowed: regular files only"},
        {"zero", "is a device, allowed: regular files only"},
        {"loop", "cannot be read: Too many levels of symbolic links"},
        {"none", "cannot be read: No such file or directory"},
        {"", "is a folder"}};
    for (const auto& [name, reason] : expected)
        for (const std::string& message : refusals(folder.path() / name)) EXPECT_THAT(message, HasSubstr(reason));
    for (const std::string& message : refusals("/dev/zero")) EXPECT_THAT(message, HasSubstr("/dev/zero: is a device"));
    EXPECT_EQ(wholeText(folder.write("a", std::string("a\0b", 3)), "a text"), std::string("a\0b", 3));
    EXPECT_FALSE(wholeText("/proc/self/status", "a text").empty());  // its reported size is 0
}

TEST(WholeText, NamesTheLimitBeforeItReads) {
    const TestFolder folder;
    const auto sparse = folder.write("sparse", "x");
    std::filesystem::resize_file(sparse, std::uintmax_t{1} << 40);
    for (const std::string& message : refusals(sparse)) EXPECT_THAT(message, HasSubstr("is too large, allowed: 64 MB"));
    std::filesystem::resize_file(sparse, 1000);
    EXPECT_EQ(wholeText(sparse, "a text", 1000).size(), 1000u);
    EXPECT_NE(refusalOf(sparse, 999), "");
    EXPECT_EQ(refusalOf(sparse, 1000), "");
    EXPECT_THAT(inputError([] { (void)wholeText("/proc/self/status", "a text", 10); }), HasSubstr("is too large"));
}

}  // namespace
}  // namespace dustbench::files
