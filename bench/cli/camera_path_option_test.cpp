// `run --camera-path`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/cli/called_program.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

TEST_F(Dustbench, ARunFollowsACameraPath) {
    std::ofstream(folder_ / "path.csv") << "time_s,eye_x,eye_y,eye_z,target_x,target_y,target_z,fov_deg\n"
                                           "0,0,6,20,0,1,0,50\n1,10,6,20,10,1,0,50\n";
    const std::string path = (folder_ / "path.csv").string();
    const auto pictureOf = [&](const std::string& name, const std::string& more) {
        const std::string folder = (folder_ / name).string();
        const Called called = shortRun("--frames 3 --images 2 --out " + folder + more);
        EXPECT_EQ(called.code, 0) << called.err;
        return contentOf(runs(folder).at(0) / "images" / "f000002.png");
    };
    const std::string chase = pictureOf("chase", "");
    const std::string followed = pictureOf("path", " --camera-path " + path);
    EXPECT_NE(followed, chase);
    EXPECT_EQ(followed, pictureOf("rows", " --camera-path '0,0,6,20,0,1,0,50;1,10,6,20,10,1,0,50'"));
    const std::string record = contentOf(runs((folder_ / "path").string()).at(0) / "run.json");
    EXPECT_THAT(record, HasSubstr("\"camera_path\": \"" + path + "\""));
    EXPECT_THAT(record, HasSubstr("{\n        \"file\": \"" + path));
    EXPECT_EQ(shortRun("--frames 1 --camera-path nowhere.csv --out " + out()).code, 3);
    EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace dustbench::cli
