// Pictures as OpenImageIO's own command writes them are read with the colours that they show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "methods/kit/pictures/image.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::pictures {
namespace {

/// What `oiiotool` makes by these arguments.
std::filesystem::path made(const TestFolder& folder, const std::string& name, const std::string& arguments) {
    std::filesystem::path file = folder.path() / name;
    const std::string command = "oiiotool " + arguments + " -o '" + file.string() + "' > /dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return file;
}

void expectEverywhere(const Image& image, const glm::vec4& colour, float within, const std::string& what) {
    ASSERT_FALSE(image.pixels.empty()) << what;
    for (const glm::vec4& pixel : image.pixels)
        for (int channel = 0; channel < 4; ++channel)
            ASSERT_NEAR(pixel[channel], colour[channel], within) << what << ", channel " << channel;
}

TEST(OtherFormats, AlphaIsTheOneOfTheFileWhereverItsChannelIs) {
    const TestFolder folder;
    const auto expectRead = [&](const char* name, const char* arguments, const glm::vec4& colour) {
        expectEverywhere(readImage(made(folder, name, arguments)), colour, 2e-3f, name);
    };
    expectRead("opaque.gif", "--pattern constant:color=0,1,1 5x3 3 -d uint8", {0, 1, 1, 1});
    expectRead("rgba.exr", "--pattern constant:color=0.5,0.25,0.125,0.5 5x3 4 -d float", {0.5f, 0.25f, 0.125f, 0.5f});
    expectRead("grey_alpha.exr", "--pattern constant:color=0.25,0.5 5x3 2 --chnames Y,A -d float",
               {0.25f, 0.25f, 0.25f, 0.5f});
    expectRead("rgba.tif", "--pattern constant:color=0.25,0.5,0.125,1 5x3 4 -d float", {0.25f, 0.5f, 0.125f, 1});
}

}  // namespace
}  // namespace dustbench::pictures
