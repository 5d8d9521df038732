// `dustbench selfcheck`: passes here, and names a picture that is wrong.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/cli/called_program.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;

class Selfcheck : public Dustbench {
 protected:
    [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
    /// A folder of data with this list of pictures and a copy of a kept one.
    [[nodiscard]] std::string dataWith(const std::string& pictures, const std::string& kept) const {
        fs::create_directories(folder_ / "data" / "scenes");
        fs::create_directories(folder_ / "data" / "selfcheck");
        std::ofstream(folder_ / "data" / "selfcheck" / "pictures.toml") << "size = \"160x120\"\n" << pictures;
        fs::copy_file(files::dataFolder() / "selfcheck" / kept, folder_ / "data" / "selfcheck" / "scenery.png");
        return " --data " + at("data");
    }
};

TEST_F(Selfcheck, PassesHereAndKeepsItsPictures) {
    const Called called = call("selfcheck --json --out " + at("out"));
    EXPECT_EQ(called.code, 0) << called.err << called.out;
    const auto found = nlohmann::json::parse(called.out);
    EXPECT_TRUE(found["passed"].get<bool>());
    EXPECT_EQ(contentOf(at("out/selfcheck.json")), called.out);
    for (const char* name : {"scenery", "billboard", "grid_fluid_solvers"})
        EXPECT_TRUE(fs::exists(at("out/pictures/" + std::string(name) + ".png"))) << name;
}

TEST_F(Selfcheck, NamesAPictureThatIsWrong) {
    const std::string scenery = "[[picture]]\nname = \"scenery\"\nmethod = \"null_method\"\nflip = 0.01\n";
    const Called called = call("selfcheck --out " + at("out") + dataWith(scenery, "volume.png"));
    EXPECT_EQ(called.code, 1) << called.out;
    EXPECT_THAT(called.err, HasSubstr("dustbench: selfcheck: picture scenery: got FLIP"));
    EXPECT_THAT(called.out, HasSubstr("other methods"));
    EXPECT_TRUE(fs::exists(at("out/pictures/scenery.difference.png")));
}

}  // namespace
}  // namespace dustbench::cli
