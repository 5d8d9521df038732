#include "bench/world/dust_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "methods/kit/maths/srgb.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class DustSeriesFile : public testing::Test {
 protected:
    [[nodiscard]] DustSeries read(const std::string& csv, const std::string& columns = "") const {
        return DustSeries::read(folder_.write("dust.csv", csv), columns);
    }
    [[nodiscard]] std::string refusal(const std::string& csv, const std::string& columns = "") const {
        return inputError([&] { (void)read(csv, columns); });
    }
    [[nodiscard]] Puffs at(const DustSeries& series, double seconds) {
        series.show(seconds, store_);
        return store_;
    }

    TestFolder folder_;
    MemoryLedger ledger_;
    particles::ParticleStore store_{ledger_};
};

constexpr const char* dustHeader = "time_s,id,x,y,z,radius,opacity\n";

TEST_F(DustSeriesFile, MovesInAStraightLineBetweenTwoMomentsByIdNotByRow) {
    const DustSeries series =
        read(std::string(dustHeader) + "5,1,0,0,0,1,0.2\n5,2,10,0,0,1,0.2\n" + "7,2,14,0,0,2,0.4\n7,1,0,8,0,1,0.2\n");
    EXPECT_DOUBLE_EQ(series.seconds(), 2);
    const Puffs dust = at(series, 0.5);
    EXPECT_THAT(std::vector<std::uint64_t>(dust.serial.begin(), dust.serial.end()), ElementsAre(1, 2));
    EXPECT_EQ(dust.position(0), glm::vec3(0, 2, 0));
    EXPECT_EQ(dust.position(1), glm::vec3(11, 0, 0));
    EXPECT_FLOAT_EQ(dust.radius[1], 1.25f);
    EXPECT_FLOAT_EQ(dust.opacity[1], 0.25f);
    EXPECT_FLOAT_EQ(dust.velocityX[1], 2);  // from its positions
    EXPECT_FLOAT_EQ(dust.age[0], 0.5f);
    EXPECT_EQ(at(series, 2).position(1), glm::vec3(0, 8, 0));
}

TEST_F(DustSeriesFile, BirthsAndDeathsHappenAtTheMomentsOfTheFiles) {
    const DustSeries series = read(
        "time_s,id,x,y,z,radius,opacity,vx,vy,vz\n0,1,0,0,0,1,0.2,3,0,0\n0,2,5,0,0,1,0.2,0,0,0\n"
        "1,2,5,0,0,1,0.2,0,0,0\n1,9,7,0,0,1,0.2,0,0,0\n");
    EXPECT_EQ(series.births(), 1u);
    EXPECT_EQ(series.deaths(), 1u);
    const Puffs dying = at(series, 0.5);
    ASSERT_EQ(dying.size(), 2u);
    EXPECT_EQ(dying.position(0), glm::vec3(1.5, 0, 0));
    const Puffs born = at(series, 1);
    EXPECT_THAT(std::vector<std::uint64_t>(born.serial.begin(), born.serial.end()), ElementsAre(2, 9));
}

TEST_F(DustSeriesFile, RoundedTimesAreTheMomentsThatTheyMean) {
    const DustSeries series =
        read(std::string(dustHeader) + "0,1,0,0,0,1,0.2\n0.0166667,1,0.1,0,0,1,0.2\n" + "0.0333333,1,0.7,0,0,1,0.2\n");
    EXPECT_EQ(at(series, 1 / 60.0).x[0], 0.1f);
    EXPECT_EQ(at(series, 2 / 60.0).x[0], 0.7f);
}

TEST_F(DustSeriesFile, OneMomentIsAStillCloudAndHoldsBeforeAndAfter) {
    const DustSeries series = read("x,y,z,radius,opacity\n1,2,3,0.5,0.1\n");
    EXPECT_TRUE(series.isStill());
    EXPECT_EQ(at(series, 99).position(0), glm::vec3(1, 2, 3));
}

TEST_F(DustSeriesFile, MassGivesTheOpacityOfTheSameDepth) {
    const DustSeries series = read("x,y,z,radius,mass\n0,0,0,2,3\n");
    EXPECT_NEAR(at(series, 0).opacity[0], 1 - std::exp(-3 / (2 * 3.14159265358979)), 1e-7);
}

TEST_F(DustSeriesFile, TakesNamesNumbersUnitsAndTheUpwardAxis) {
    const DustSeries series =
        read("px,py,pz,R,tau\n100,200,300,50,0\n", "position=px+py+pz,radius=R,opacity=0.25,scale=0.01,up=z");
    const Puffs dust = at(series, 0);
    EXPECT_EQ(dust.position(0), glm::vec3(1, 3, -2));
    EXPECT_FLOAT_EQ(dust.radius[0], 0.5f);
    EXPECT_FLOAT_EQ(dust.opacity[0], 0.25f);
    const auto toml = folder_.write("columns.toml", "position = [\"px\", \"py\", \"pz\"]\nopacity = 0.5\n");
    EXPECT_FLOAT_EQ(at(read("px,py,pz,R\n1,1,1,1\n", toml.string()), 0).opacity[0], 0.5f);
}

TEST_F(DustSeriesFile, EachFaultIsOneClearLine) {
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,3,-1,0.1\n"), HasSubstr("particle 0: radius is -1, allowed"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,nan,1,0.1\n"), HasSubstr("dust.csv:2"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,1e300,1,0.1\n"), HasSubstr("is 1e+300, allowed"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,3,1,1.5\n"), HasSubstr("opacity is 1.5, allowed: 0..1"));
    EXPECT_THAT(refusal("x,y,radius,opacity\n1,2,1,1\n"), HasSubstr("no column for position; it has: x, y"));
    EXPECT_THAT(refusal("x,y,z,opacity\n1,2,1,1\n"), HasSubstr("no column for radius"));
    EXPECT_THAT(refusal("x,y,z,\"two\nlines\"\n1,2,1,1\n"), HasSubstr("no column for radius"));
    EXPECT_THAT(refusal("x,y,z,radius\n1,2,1,1\n"), HasSubstr("no column for opacity or mass"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,3,1,0.1\n", "radius=width"), HasSubstr("no column 'width'"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,3,1,0.1\n", "radios=width"), HasSubstr("did you mean 'radius'"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,3,1,0.1\n", "up=x"), HasSubstr("up: got 'x', allowed: y, z"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity\n1,2,3,1,0.1\n", "scale"), HasSubstr("expected key=COLUMN"));
    const std::string one = "0,1,0,0,0,1,0.2\n";
    EXPECT_THAT(refusal(dustHeader + one + one), HasSubstr("id: 1 appears twice"));
    EXPECT_THAT(refusal(dustHeader + std::string("0,1.5,0,0,0,1,0.2\n")),
                HasSubstr("id is 1.5, allowed: whole numbers"));
    EXPECT_THAT(refusal(dustHeader + std::string("1,1,0,0,0,1,0.2\n") + one), HasSubstr("expected more than 1 s"));
    EXPECT_THAT(refusal("time_s,x,y,z,radius,opacity\n0,1,1,1,1,0.1\n1,1,1,1,1,0.1\n1,1,1,1,1,0.1\n"),
                HasSubstr("has 2 particles, expected 1"));
}

TEST_F(DustSeriesFile, BytesOfColoursAreSrgbAndFloatsLinear) {
    const auto colourOf = [&](const std::string& type, int components, const std::string& numbers) {
        const auto array = [](const std::string& kind, const std::string& name, int count, const std::string& text) {
            return "<DataArray type=\"" + kind + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                   std::to_string(count) + "\" format=\"ascii\">" + text + "</DataArray>";
        };
        const DustSeries series = DustSeries::read(
            folder_.write("a.vtp", "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1\"><PointData>" +
                                       array("Float32", "radius", 1, "1") + array("Float32", "opacity", 1, "0.5") +
                                       array(type, "colour", components, numbers) + "</PointData><Points>" +
                                       array("Float32", "Points", 3, "0 0 0") +
                                       "</Points></Piece></PolyData></VTKFile>"),
            "");
        const Puffs dust = at(series, 0);
        return glm::vec3(dust.red[0], dust.green[0], dust.blue[0]);
    };
    const auto expectColour = [](const glm::vec3& colour, const glm::vec3& expected) {
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(colour[i], expected[i], 1e-6f);
    };
    const glm::vec3 encoded(maths::decodeSrgb(128 / 255.0f), maths::decodeSrgb(64 / 255.0f), 1);
    expectColour(colourOf("UInt8", 3, "128 64 255"), encoded);
    expectColour(colourOf("UInt8", 4, "128 64 255 0"), encoded);
    expectColour(colourOf("Float32", 3, "0.5 0.25 1"), {0.5f, 0.25f, 1});
    expectColour(colourOf("Float64", 4, "0.5 2.25 1 1"), {0.5f, 2.25f, 1});
    for (const char* type : {"UInt16", "Float32"})
        EXPECT_THAT(inputError([&] { (void)colourOf(type, 3, "128 64 26"); }),
                    HasSubstr("colour has whole numbers up to 128, expected linear light"));
    EXPECT_THAT(refusal("x,y,z,radius,opacity,red,green,blue\n1,2,3,1,0.1,255,0,0\n"),
                HasSubstr("red+green+blue has whole numbers up to 255"));
}

TEST_F(DustSeriesFile, NamesAreReadTogether) {
    const Puffs coloured = at(read("x,y,z,R,G,B,pscale,opacity\n1,2,3,0.9,0.5,0.25,2,0.1\n"), 0);
    EXPECT_EQ(coloured.radius[0], 2);
    EXPECT_EQ(glm::vec3(coloured.red[0], coloured.green[0], coloured.blue[0]), glm::vec3(0.9f, 0.5f, 0.25f));
    EXPECT_EQ(at(read("x,y,z,R,pscale,opacity\n1,2,3,0.9,2,0.1\n"), 0).radius[0], 0.9f);  // alone, R is the radius
    EXPECT_EQ(at(read("x,y,z,R,G,pscale,opacity\n1,2,3,0.9,0.5,2,0.1\n"), 0).radius[0], 0.9f);
    EXPECT_THAT(refusal("x,y,z,R,G,B,opacity\n1,2,3,0.9,0.5,0.25,0.1\n"), HasSubstr("no column for radius"));
    EXPECT_EQ(at(read("x,y,z,R,G,B,opacity\n1,2,3,0.9,0.5,0.25,0.1\n", "radius=R"), 0).radius[0], 0.9f);
}

class DustIndex : public DustSeriesFile {
 protected:
    void SetUp() override {
        folder_.write("a.csv", "x,y,z,radius,opacity\n1,2,3,1,0.1\n");
        folder_.write("b.csv", "x,y,z,radius,opacity\n2,2,3,1,0.1\n");
    }
    [[nodiscard]] DustSeries index(const std::string& name, const std::string& text) const {
        return DustSeries::read(folder_.write(name, text), "");
    }
    [[nodiscard]] std::string refusalOf(const std::string& name, const std::string& text) const {
        return inputError([&] { (void)index(name, text); });
    }
};

TEST_F(DustIndex, ReadsCollectionsAndFileSeries) {
    const DustSeries pvd = index("d.pvd",
                                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>\n<DataSet "
                                 "timestep='2' part='0' file='a.csv'/>\n<DataSet timestep='4' file='b.csv'/>\n"
                                 "</Collection></VTKFile>\n");
    EXPECT_DOUBLE_EQ(pvd.seconds(), 2);
    folder_.write("a & <\xc3\xa4>.csv", "x,y,z,radius,opacity\n1,2,3,1,0.1\n");
    for (const char* named : {"a &amp; &lt;&#228;&gt;.csv", "a &#x26; &#60;&#xE4;>.csv"})
        EXPECT_EQ(
            index("e.pvd", std::string("<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"") +
                               named + "\"/></Collection></VTKFile>")
                .files()
                .back()
                .filename(),
            "a & <\xc3\xa4>.csv");
    EXPECT_THAT(
        refusalOf("e.pvd", "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"a &nbsp;\"/>"),
        HasSubstr("the reference '&nbsp;'"));
    EXPECT_EQ(pvd.files().size(), 3u);
    const DustSeries series = index("d.csv.series",
                                    R"({"file-series-version": "1.0", "files": [{"name": "a.csv", "time": 0},
                                        {"name": "b.csv", "time": 0.5}]})");
    EXPECT_DOUBLE_EQ(series.seconds(), 0.5);
    EXPECT_FLOAT_EQ(at(series, 0.25).x[0], 1.5f);
}

TEST_F(DustIndex, DamagedOnesAreRefused) {
    EXPECT_THAT(refusalOf("d.series", "{\"files\": 3}"), HasSubstr("expected an object with an array 'files'"));
    EXPECT_THAT(refusalOf("d.series", "{\"files\": [{\"name\": \"a.csv\"}]}"),
                HasSubstr("lacks a file or a numeric time"));
    EXPECT_THAT(refusalOf("d.series", "{\"files\": []}"), HasSubstr("names no files"));
    EXPECT_THAT(refusalOf("d.series", "{\"files\": [{\"name\": \"gone.csv\", \"time\": 0}]}"), HasSubstr("gone.csv"));
    EXPECT_THAT(refusalOf("d.pvd", "<VTKFile type=\"Collection\"><Collection>"), HasSubstr("ends within its XML"));
    EXPECT_THAT(refusalOf("d.pvd", "<VTKFile type=\"PolyData\"></VTKFile>"), HasSubstr("it is not a collection"));
    EXPECT_THAT(refusalOf("d.series", R"({"files": [{"name": "a.csv", "time": 1}, {"name": "b.csv", "time": 1}]})"),
                HasSubstr("expected more than 1 s"));
    folder_.write("b.csv", "x,y,z,radius,opacity,age\n2,2,3,1,0.1,1\n");
    EXPECT_THAT(refusalOf("d.series", R"({"files": [{"name": "a.csv", "time": 1}, {"name": "b.csv", "time": 2}]})"),
                HasSubstr("has position, radius, opacity, age, expected position, radius, opacity as in"));
    EXPECT_THAT(inputError([&] { (void)DustSeries::read(folder_.path() / "d.obj", ""); }),
                HasSubstr("expected a file that ends in"));
}

}  // namespace
}  // namespace dustbench::world
