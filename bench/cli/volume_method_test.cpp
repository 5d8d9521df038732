// The method `volume`, and dust made from a volume. Our own exporter writes the volumes, so the ground truth is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/cli/called_program.h"
#include "methods/kit/files/csv.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class VolumeMethod : public Dustbench {
 protected:
    static constexpr const char* world =
        " --scene sphere -P camera=fixed --size 96x72 --warmup 1 -P preroll=0 --threads 2 ";

    /// One Gaussian puff in the view of the fixed camera.
    [[nodiscard]] std::string puff() const {
        const fs::path file = folder_ / "puff.csv";
        std::ofstream(file) << "x,y,z,radius,opacity\n0,1.5,0,1,0.8\n";
        return file.string();
    }
    /// The same as a volume with this many voxels along its edge, written by our own exporter.
    [[nodiscard]] std::string volume(const std::string& format, int cells) const {
        const std::string to = fmt::format("{}/{}{}", folder_.string(), format, cells);
        const Called called =
            call("export --method billboard --frames 0:1:1 --format " + format + " --dust " + puff() + world +
                 fmt::format("--resolution {} --region=-2,-0.5,-2,2,3.5,2 --out {}", cells, to));
        EXPECT_EQ(called.code, 0) << called.err;
        for (const auto& entry : fs::recursive_directory_iterator(to))
            if (entry.path().extension() == "." + format) return entry.path().string();
        return "";
    }
    [[nodiscard]] std::string run(const std::string& name, const std::string& more) const {
        const std::string to = (folder_ / name).string();
        const Called called = call("run --images 1 --metrics " + std::string(world) + more +
                                   (more.find("--frames") == std::string::npos ? " --frames 2" : "") + " --out " + to);
        EXPECT_EQ(called.code, 0) << called.err;
        return to;
    }
    [[nodiscard]] static double summary(const std::string& results, const std::string& column) {
        return files::CsvTable::parseFile(results + "/summary.csv").number(0, column);
    }
};

/// Mass of that puff: −ln(1 − 0.8)·2π/4 m².
constexpr double mass = 2.5281;

TEST_F(VolumeMethod, ShowsAPuffAsItsClosedFormDoesByEveryRenderer) {
    const std::string exact = " --dust " + puff();
    const std::string file = volume("vti", 64);
    struct Case {
        const char* setting;
        double errorMax;  ///< in linear light, over all pixels
    };
    for (const auto& [setting, errorMax] : {Case{"backend=cpu", 0.004}, Case{"backend=gl", 0.004},
                                            Case{"renderer=slices", 0.01}, Case{"renderer=splat", 0.03}}) {
        const std::string results =
            run(setting, "--method volume -P stop_alpha=1 -P volume=" + file + " -P " + setting + exact);
        EXPECT_LT(summary(results, "error_max"), errorMax) << setting;
        EXPECT_NEAR(summary(results, "volume_mass"), mass, 0.001 * mass) << setting;
        EXPECT_LT(summary(results, "volume_error"), 0.05) << setting;  // of cells twice as wide
    }
}

TEST_F(VolumeMethod, ErrorsFallWithTheSquareOfTheCellsEdge) {
    const auto error = [&](int cells) {
        return summary(run(std::to_string(cells), "--method volume -P stop_alpha=1 -P step_cells=0.25 -P volume=" +
                                                      volume("vti", cells) + " --dust " + puff()),
                       "error_max");
    };
    const double ratio = error(16) / error(32);
    EXPECT_GT(ratio, 3);
    EXPECT_LT(ratio, 5);
}

TEST_F(VolumeMethod, OpenVdbAndVtkFilesOfOneVolumeGiveOnePicture) {
    const std::string rest = " --dust " + puff();
    const std::string one = run("of_vti", "--method volume -P backend=cpu -P volume=" + volume("vti", 32) + rest);
    const std::string other = run("of_vdb", "--method volume -P backend=cpu -P volume=" + volume("vdb", 32) + rest);
    EXPECT_NEAR(summary(one, "error_max"), summary(other, "error_max"), 1e-4);
    EXPECT_NEAR(summary(one, "volume_mass"), summary(other, "volume_mass"), 1e-4);  // half floats
}

TEST_F(VolumeMethod, ParticlesMadeOfAVolumeGiveTheVolumesPicture) {
    const std::string file = volume("vdb", 32);
    // Here the reference image is that of the particles, and the volume is compared with it.
    const std::string results = run("held", "--method volume -P stop_alpha=1 -P volume=" + file + " --dust " + file);
    EXPECT_LT(summary(results, "error_max"), 0.02);
    EXPECT_LT(summary(results, "volume_error"), 0.1);
    // The colour of its file is used, too.
    std::ofstream(folder_ / "blue.toml") << "files = \"" << file << "\"\n[look]\nalbedo = [0.1, 0.2, 0.9]\n";
    const std::string blue = (folder_ / "blue.toml").string();
    const std::string coloured = run("blue", "--method volume -P stop_alpha=1 -P volume=" + blue + " --dust " + blue);
    EXPECT_LT(summary(coloured, "error_max"), 0.02);
    const std::string billboards = run("billboards", "--method billboard --dust " + file);
    EXPECT_GT(summary(billboards, "particles_median"), 1000);
    EXPECT_GT(summary(billboards, "psnr_db"), 45);
}

TEST_F(VolumeMethod, TheSunLightsIt) {
    const std::string file = volume("vti", 32);
    const std::string results = run("lit", "--method volume -P light=sun -P volume=" + file + " --dust " + puff());
    EXPECT_LT(summary(results, "rmse_linear_mask"), 0.05);
    const Called called = call("run --method volume --frames 1 -P light=sun -P renderer=splat -P volume=" + file +
                               world + " --out " + out());
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("parameter renderer: got splat with light=sun"));
}

TEST_F(VolumeMethod, InputsAreInTheRecordAndWhatEndsTooEarlyIsInvalid) {
    const std::string file = volume("vti", 16);
    const fs::path folder = fs::path(file).parent_path();
    const std::string record = contentOf(runs(run("out", "--method volume -P volume=" + file)).front() / "run.json");
    EXPECT_THAT(record, HasSubstr("\"file\": \"" + file + "\""));
    std::ofstream(folder / "two.series") << R"({"files": [{"name": ")" << fs::path(file).filename().string()
                                         << R"(", "time": 0}, {"name": ")" << fs::path(file).filename().string()
                                         << R"(", "time": 0.1}]})";
    const std::string two = "--method volume -P volume=" + (folder / "two.series").string();
    const std::string within = run("within", two + " --frames 7"), beyond = run("beyond", two + " --frames 8");
    EXPECT_EQ(summary(within, "volume_held"), 0);
    EXPECT_THAT(contentOf(beyond + "/summary.csv"), HasSubstr("volume_held"));
    EXPECT_NEAR(summary(beyond, "volume_held"), 1.0 / 60, 1e-6);
    EXPECT_NE(files::CsvTable::parseFile(beyond + "/summary.csv").cell(0, "invalid"), "");
}

TEST_F(VolumeMethod, WhatOfItsFilesNobodyUsesIsSaidOnceAndRecorded) {
    for (const char* name : {"s_1.vti", "s_2.vti"})
        std::ofstream(folder_ / name)
            << "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData WholeExtent=\"0 2 0 "
               "1 0 1\""
               " Origin=\"0 1 0\" Spacing=\"1 1 1\"><FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" "
               "NumberOfTuples=\"1\" format=\"ascii\">"
            << name[2]
            << "</DataArray></FieldData><Piece Extent=\"0 2 0 1 0 1\"><CellData><DataArray type=\"Float32\" "
               "Name=\"density\" format=\"ascii\">1 2</DataArray><DataArray type=\"Int32\" Name=\"material\" "
               "format=\"ascii\">7 7</DataArray><DataArray type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">0 0"
               "</DataArray></CellData></Piece></ImageData></VTKFile>";
    std::ofstream(folder_ / "dust.csv") << "x,y,z,radius,opacity,note\n0,1.5,0,1,0.8,a\n";
    const Called called = call("run --method volume -P volume=" + (folder_ / "s_*.vti").string() + " --dust " +
                               (folder_ / "dust.csv").string() + " --frames 1" + world + "--out " + out());
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(called.out,
                HasSubstr("\n  ignored: dust.csv: column 'note'; s_1.vti and 1 other file: array 'material' at "
                          "cells\n"));
    const std::string record = contentOf(runs(out()).front() / "run.json");
    EXPECT_THAT(record, AllOf(HasSubstr("\"ignored\": ["), HasSubstr("s_2.vti\",\n        \"parts\": ["),
                              HasSubstr("\"array 'material' at cells\"")));
    const Called clean = call("run --method billboard --frames 1" + std::string(world) + "--out " + out() + "/clean");
    EXPECT_EQ(clean.out.find("ignored"), std::string::npos);
}

TEST_F(VolumeMethod, BadFilesAreOneLine) {
    std::ofstream(folder_ / "bad.vdb") << "no volume";
    std::ofstream(folder_ / "bad.vti") << "<VTKFile type=\"ImageData\">";
    std::ofstream(folder_ / "bad.nvdb") << "no volume";
    for (const char* name : {"bad.vdb", "bad.vti", "bad.nvdb", "none.vdb", "none*.vti"}) {
        const std::string file = (folder_ / name).string();
        for (const std::string& use : {"--method volume -P volume=" + file, "--method billboard --dust " + file}) {
            const Called called = call("run --frames 1 " + use + world + "--out " + out());
            EXPECT_EQ(called.code, 3) << called.err;
            EXPECT_THAT(called.err, HasSubstr(name));
            const std::size_t first = called.err.find("dustbench: ");  // after the line that reports the start of a run
            EXPECT_EQ(called.err.find('\n', first) + 1, called.err.size()) << called.err;
        }
    }
}

}  // namespace
}  // namespace dustbench::cli
