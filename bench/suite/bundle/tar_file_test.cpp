#include "bench/suite/bundle/tar_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "bench/results/temporary_folder.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::suite {
namespace {
namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

class TarFile : public testing::Test {
 protected:
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((path() / name).parent_path());
        std::ofstream(path() / name, std::ios::binary) << bytes;
    }
    [[nodiscard]] std::string bytesOf(const std::string& name) const {
        return files::wholeText(path() / name, "a file");
    }
    [[nodiscard]] std::string refusal() const {
        return inputError([&] { (void)extractTar(path() / "a.tar", path() / "out"); });
    }
    /// Runs `tar` in the folder.
    void tar(const std::string& arguments) const {
        const std::string command = "cd '" + path().string() + "' && tar " + arguments;
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
    }
    [[nodiscard]] const fs::path& path() const { return folder_.path(); }

 private:
    results::TemporaryFolder folder_;
};

std::string randomBytes(std::size_t count, unsigned seed) {
    std::mt19937 engine(seed);
    std::string bytes(count, '\0');
    for (char& byte : bytes) byte = static_cast<char>(engine());
    return bytes;
}

const std::string longName = std::string(90, 'f') + "/" + std::string(40, 'g') + "/" + std::string(96, 'n') + ".png";

TEST_F(TarFile, WhatGoesInComesOut) {
    std::vector<std::pair<std::string, std::string>> contents;
    for (const std::size_t count : {0, 1, 511, 512, 513, 65536, 70000})
        contents.emplace_back("folder/" + std::to_string(count), randomBytes(count, 29 + static_cast<unsigned>(count)));
    contents.emplace_back(longName, "long");
    TarWriter writer(path() / "a.tar");
    std::vector<std::string> names;
    for (const auto& [name, bytes] : contents) {
        write("in/" + name, bytes);
        writer.add(name, path() / "in" / name);
        names.push_back(name);
    }
    writer.addText("text", "as it is\n");
    names.emplace_back("text");
    writer.finish();
    EXPECT_EQ(extractTar(path() / "a.tar", path() / "out"), names);
    for (const auto& [name, bytes] : contents) EXPECT_EQ(bytesOf("out/" + name), bytes) << name;
    EXPECT_EQ(bytesOf("out/text"), "as it is\n");
    fs::create_directory(path() / "tars");
    tar("-xf a.tar -C tars");
    tar("-df a.tar -C tars");
    for (const auto& [name, bytes] : contents) EXPECT_EQ(bytesOf("tars/" + name), bytes) << name;
}

TEST_F(TarFile, EqualContentsGiveEqualBytes) {
    for (const char* name : {"a.tar", "b.tar"}) {
        TarWriter writer(path() / name);
        write("in", "the same");
        writer.add("in", path() / "in");
        writer.finish();
    }
    EXPECT_EQ(bytesOf("a.tar"), bytesOf("b.tar"));
}

TEST_F(TarFile, ReadsWhatTarWrites) {
    write("one/two", randomBytes(3000, 5));
    tar("--format=ustar -cf a.tar one/two");
    EXPECT_THAT(extractTar(path() / "a.tar", path() / "out"), testing::ElementsAre("one/two"));
    EXPECT_EQ(bytesOf("out/one/two"), randomBytes(3000, 5));
}

TEST_F(TarFile, WhatIsNoFileBelowTheFolderIsRefused) {
    write("one/two", "2");
    tar("--format=ustar -cf a.tar one");
    EXPECT_THAT(refusal(), HasSubstr("'one/' is not a regular file"));
    tar("--format=ustar -P --transform 's,one,../one,' -cf a.tar one/two");
    EXPECT_THAT(refusal(), HasSubstr("'../one/two' points outside the bundle"));
    EXPECT_FALSE(fs::exists(path() / "one.tar"));
    tar("--format=ustar -P -cf a.tar \"$PWD/one/two\"");
    EXPECT_THAT(refusal(), HasSubstr("points outside the bundle"));
    tar("--format=ustar -cf a.tar one/two one/two --hard-dereference");
    EXPECT_THAT(refusal(), HasSubstr("'one/two' appears twice"));
    fs::create_symlink("/etc/passwd", path() / "link");
    tar("--format=ustar -cf a.tar link");
    EXPECT_THAT(refusal(), HasSubstr("'link' is not a regular file"));
}

TEST_F(TarFile, WhatIsDamagedIsRefused) {
    TarWriter writer(path() / "whole.tar");
    writer.addText("a", randomBytes(1000, 7));
    writer.addText("b", "b");
    writer.finish();
    const std::string whole = bytesOf("whole.tar");
    std::mt19937 engine(11);
    for (int i = 0; i < 300; ++i) {  // flip a bit of a header
        std::string damaged = whole;
        const std::size_t at = std::uniform_int_distribution<std::size_t>(0, 511)(engine);
        damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ (1U << (engine() % 8)));
        write("a.tar", damaged);
        EXPECT_THAT(refusal(), AnyOf(HasSubstr("invalid entry header"))) << at;
    }
    for (const std::size_t length : {std::size_t{0}, std::size_t{100}, std::size_t{512}, std::size_t{1400},
                                     std::size_t{2048}, whole.size() - 1024}) {
        write("a.tar", whole.substr(0, length));
        EXPECT_THAT(refusal(), HasSubstr("is truncated")) << length;
    }
    write("a.tar", randomBytes(5000, 3));
    EXPECT_THAT(refusal(), HasSubstr("not a dustbench bundle"));
    fs::remove(path() / "a.tar");
    EXPECT_THAT(refusal(), HasSubstr("No such file"));
}

TEST_F(TarFile, ANameThatDoesNotFitIsRefused) {
    TarWriter writer(path() / "a.tar");
    EXPECT_THAT(inputError([&] { writer.addText(std::string(101, 'n'), ""); }), HasSubstr("too long"));
    EXPECT_THAT(inputError([&] { writer.addText(std::string(156, 'f') + "/n" + std::string(100, 'n'), ""); }),
                HasSubstr("too long"));
    EXPECT_NO_THROW(writer.addText(std::string(155, 'f') + "/" + std::string(100, 'n'), ""));
}

}  // namespace
}  // namespace dustbench::suite
