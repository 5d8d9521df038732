// Reads mutants of valid files with all readers: each is read or refused in one line. After a crash the file is in the
// temporary folder, as `fuzz-<name>`. 300 cases each, or DUSTBENCH_FUZZ_CASES; DUSTBENCH_FUZZ_SEED selects others.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>

#include "bench/export/format_writers.h"
#include "bench/report/page.h"
#include "bench/report/report_reader.h"
#include "bench/results/run_record.h"
#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "bench/suite/suite.h"
#include "bench/world/cameras.h"
#include "bench/world/control_source.h"
#include "bench/world/dust_series.h"
#include "bench/world/panel_table.h"
#include "bench/world/scene_file.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/kit/particles/part_toml.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/volume_file.h"
#include "methods/kit/volumes/volume_series.h"
#include "source_folder.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/nano_ball.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace dustbench::fuzz {
namespace {

namespace fs = std::filesystem;

/// A number from the environment, at least 1.
int given(const char* name, int initial) {
    const char* const text = std::getenv(name);
    return text ? std::max(std::atoi(text), 1) : initial;
}

int cases() {
    return given("DUSTBENCH_FUZZ_CASES", 300);
}

std::uint32_t seed() {
    return static_cast<std::uint32_t>(given("DUSTBENCH_FUZZ_SEED", 20'260'728));
}

fs::path data(const char* name) {
    return files::dataFolder() / name;
}

std::string bytesOf(const fs::path& file) {
    return files::wholeText(file, "a file to mutate", files::limits::geometryBytes);
}

/// `name` has the extension that the reader expects; mutants are written next to the original if that names other
/// files.
void expectSound(const std::string& name, const std::string& original, const std::function<void(const fs::path&)>& read,
                 const fs::path& folder = fs::temp_directory_path(), int count = cases()) {
    const fs::path file = folder / ("fuzz-" + name);
    const auto write = [&](const std::string& text) { std::ofstream(file, std::ios::binary) << text; };
    write(original);
    EXPECT_NO_THROW(read(file)) << name;
    Mutation mutate(seed());
    int refused = 0;
    for (int n = 0; n < count; ++n) {
        write(mutate(original));
        try {
            read(file);
        } catch (const InputError& error) {
            ++refused;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos)
                << name << ", seed " << seed() << ", case " << n;
        }  // any other exception ends the test, and the file stays
    }
    EXPECT_TRUE(refused > 0 || count < 10) << name;
    fs::remove(file);
}

pictures::Image smallImage() {
    pictures::Image image{12, 9, {}};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> share(0, 1);
    for (int i = 0; i < 12 * 9; ++i) image.pixels.emplace_back(share(random), share(random), share(random), 1);
    return image;
}

TEST(Fuzz, Tables) {
    expectSound("a.toml", bytesOf(data("scenes/plain.toml")), [](const fs::path& file) {
        files::TomlReader reader = files::TomlReader::parseFile(file);
        for (const std::string& key : reader.keys())
            if (reader.has(key)) (void)reader.where(key);
    });
    expectSound("a.csv", bytesOf(data("drives/slalom.csv")),
                [](const fs::path& file) { (void)files::CsvTable::parseFile(file); });
}

TEST(Fuzz, Meshes) {
    const auto read = [](const fs::path& file) {
        const scene::Mesh mesh = meshes::readMesh(file, {});
        for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
    };
    for (const char* name : {"rock.obj", "crate.ply", "marker_post.stl"})
        expectSound(name, bytesOf(data("scenes/meshes") / name), read);
    expectSound("all.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 2//1 -1//1 3//1\n", read);
    expectSound(
        "edges.ply",
        "ply\nformat ascii 1.0\nelement edge 1\nproperty int a\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n7\n0 0 0\n1 0 0\n0 1 0\n"
        "3 0 1 2\n",
        read);
    expectSound("text.stl",
                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                "0\nendloop\nendfacet\nendsolid a\n",
                read);
}

/// Leaks inside are ignored: some damaged PNG files leave a text of 31 bytes. Our own reader uses libpng's simplified
/// interface, which keeps nothing, so the leak is probably in OpenImageIO, which reads all PNG except plain 8-bit ones.
void readPicture(const fs::path& file) {
#if defined(__SANITIZE_ADDRESS__)
    const __lsan::ScopedDisabler notCounted;
#endif
    (void)pictures::readImage(file);
}

TEST(Fuzz, Pictures) {
    const TestFolder folder;
    for (const char* name : {"a.png", "a.exr"}) {
        pictures::writeImage(smallImage(), folder.path() / name);
        expectSound(name, bytesOf(folder.path() / name), readPicture);
    }
    expectSound("a.pgm", "P5\n3 2\n255\nabcdef",
                [](const fs::path& file) { (void)world::readHeightImage(file, 1, 1, 0); });
}

TEST(Fuzz, Results) {
    results::RunRecord record;
    record.spec.method = "haze";
    record.summary = results::identityColumns(record, 2);
    record.summary.emplace_back("frame_ms_median", 12.5);
    record.provenance.warnings = {"slow"};
    expectSound("run.json", results::toJson(record), [](const fs::path& file) { (void)results::readRunFile(file); });
}

TEST(Fuzz, ReportsOverDamagedFolders) {
    const TestFolder folder;
    results::RunRecord record;
    record.spec.method = "haze";
    record.summary = results::identityColumns(record, 2);
    record.summary.emplace_back("frame_ms_median", 12.5);
    const fs::path run = folder.path() / "runs" / results::runId(record.spec);
    fs::create_directories(run);
    const auto write = [](const fs::path& file, const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
    };
    Mutation mutate(seed() + 28);
    const std::string frames = "frame,frame_ms\n0,1.5\n1,2.5\n", summary = "run_id,status,repetition\nx,done,1\n";
    for (int n = 0; n < std::max(cases() / 20, 1); ++n) {
        write(run / "run.json", n % 2 == 0 ? results::toJson(record) : mutate(results::toJson(record)));
        write(run / "frames.csv", mutate(frames));
        write(folder.path() / "summary.csv", mutate(summary));
        const report::ReportData data = report::readReport(folder.path(), 1'000'000);
        EXPECT_FALSE(data.runs.empty() && data.problems.empty());
        EXPECT_NO_THROW((void)report::writePage(folder.path(), data));
    }
}

TEST(Fuzz, Worlds) {
    expectSound("drive.csv", bytesOf(data("drives/slalom.csv")),
                [](const fs::path& file) { (void)world::Drive::parseFile(file); });
    expectSound("camera.csv",
                "time_s,eye_x,eye_y,eye_z,target_x,target_y,target_z,fov_deg\n0,1,2,3,4,5,6,50\n2,1,2,9,4,5,6,50\n",
                [](const fs::path& file) { (void)world::CameraPath::parseFile(file); });
    expectSound("dust.toml", bytesOf(data("particles/fountain.toml")),
                [](const fs::path& file) { (void)particles::systemsFromFile(file); });
    expectSound("scene.toml", bytesOf(data("scenes/plain.toml")),
                [](const fs::path& file) { (void)world::readScene(file); });
    // A relief names pictures in its folder.
    const TestFolder folder;
    fs::copy(data("reliefs"), folder.path(), fs::copy_options::recursive);
    expectSound(
        "relief.toml", bytesOf(data("reliefs/sign.toml")), [](const fs::path& file) { (void)world::readRelief(file); },
        folder.path());
}

exports::CollectedGrid smallGrid() {
    exports::CollectedGrid grid;
    grid.cells = {5, 4, 3};
    grid.originMetres = glm::dvec3(0);
    grid.spacingMetres = 0.25;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any(-1, 1);
    grid.fields.emplace_back();
    grid.fields[0].name = "velocity";
    grid.fields[0].components = 3;
    for (int i = 0; i < 5 * 4 * 3 * 3; ++i) grid.fields[0].values.push_back(any(random));
    return grid;
}

TEST(Fuzz, Volumes) {
    const TestFolder folder;
    const auto read = [](const fs::path& file) { (void)volumes::readVectors(file, "velocity"); };
    exports::writeGridVti(smallGrid(), 1, folder.path() / "blocks.vti");
    expectSound("blocks.vti", bytesOf(folder.path() / "blocks.vti"), read);
    expectSound("whirl.vti", bytesOf(data("shapes/flow/whirl_0.vti")), read);
    expectSound(
        "text.vti",
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"0 2 0 1 0 "
        "1\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\n<Piece Extent=\"0 2 0 1 0 1\">\n<CellData>\n<DataArray "
        "type=\"Float32\" Name=\"velocity\" NumberOfComponents=\"3\" format=\"ascii\">\n1 2 3 4 5 6\n</DataArray>\n"
        "</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n",
        read);
}

/// A reader that does not keep the whole box gets one number per cell, or the file is refused.
struct CellCount final : volumes::VolumeSink {
    void begin(const volumes::GridPlace& place) override { expected = place.cellCount(); }
    bool beginField(std::string_view field) override { return field == "density"; }
    void take(std::span<const float> numbers) override { got += numbers.size(); }
    std::size_t expected = 0, got = 0;
};

void readDensity(const fs::path& file) {
    (void)volumes::readVolume(file, {});
    CellCount count;
    volumes::streamVolume(file, {}, count);
    EXPECT_EQ(count.got, count.expected);
}

TEST(Fuzz, Densities) {
    expectSound("cloud.vti", bytesOf(data("volumes/cloud.vti")), readDensity);
    expectSound(
        "points.vti",
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"0 1 0 1 0 "
        "1\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\n<Piece Extent=\"0 1 0 1 0 1\">\n<PointData>\n<DataArray "
        "type=\"Float32\" Name=\"density\" format=\"ascii\">\n1 2 3 4 5 6 7 8\n</DataArray>\n</PointData>\n</Piece>\n"
        "</ImageData>\n</VTKFile>\n",
        readDensity);
    const TestFolder folder;
    fs::copy(data("volumes/cloud.vti"), folder.path());
    expectSound(
        "volume.toml",
        "files = \"cloud.vti\"\nup = \"z\"\nscale = 2.0\nposition = [1, 2, 3]\n[look]\nshadow_cells = 2\n[particles]\n"
        "block_cells = 2\n",
        [](const fs::path& file) { (void)volumes::VolumeSeries::read(volumes::readVolumeSetup(file)); }, folder.path(),
        std::max(cases() / 3, 1));
}

/// Each file is read in a separate process, which takes a while and may end in any way.
TEST(Fuzz, VolumesOfOpenVdb) {
    const TestFolder folder;
    exports::writeGridVdb(smallGrid(), 1, 1, folder.path() / "small.vdb");
    expectSound(
        "small.vdb", bytesOf(folder.path() / "small.vdb"),
        [](const fs::path& file) { (void)volumes::readVectors(file, "velocity"); }, fs::temp_directory_path(),
        std::max(cases() / 2, 1));
    exports::CollectedGrid fog = smallGrid();
    fog.fields[0].name = "density";
    fog.fields[0].components = 1;
    fog.fields[0].values.resize(5 * 4 * 3);
    for (float& value : fog.fields[0].values) value = std::abs(value);
    exports::writeGridVdb(fog, 1, 1, folder.path() / "fog.vdb");
    writeNanoBall(folder.path() / "ball.nvdb");
    for (const char* name : {"fog.vdb", "ball.nvdb"})
        expectSound(name, bytesOf(folder.path() / name), readDensity, fs::temp_directory_path(),
                    std::max(cases() / 2, 1));
    // Five points with radii, as openvdb/vdb_mutants.cpp writes them.
    const fs::path points = fs::path(DUSTBENCH_SOURCE_DIR) / "tests/fuzz/points.vdb";
    expectSound(
        "points.vdb", bytesOf(points),
        [](const fs::path& file) { (void)volumes::readVdbPoints(file, [](std::string_view) { return true; }); },
        fs::temp_directory_path(), std::max(cases() / 2, 1));
}

/// An index is mutated in the folder of the file that it names.
TEST(Fuzz, DustFromFiles) {
    const TestFolder folder;
    const auto read = [](const fs::path& file) { (void)world::DustSeries::read(file, ""); };
    const std::vector<float> numbers{0.25f, 0.5f, 0.75f};
    const std::vector<std::uint64_t> serials{3, 4, 9};
    Puffs dust;
    dust.serial = serials;
    for (auto* column : {&dust.x, &dust.y, &dust.z, &dust.velocityX, &dust.velocityY, &dust.velocityZ, &dust.age,
                         &dust.lifetime, &dust.radius, &dust.opacity})
        *column = numbers;
    exports::writeVtp(dust, 1.5, folder.path() / "one.vtp");
    const std::string whole = bytesOf(folder.path() / "one.vtp");
    expectSound("dust.vtp", whole, read);
    expectSound("dust_text.vtp",
                "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"2\"><PointData>\n<DataArray "
                "type=\"Float64\" Name=\"R\">1 2</DataArray>\n<DataArray type=\"Float32\" Name=\"alpha\">0.5 1"
                "</DataArray></PointData>\n<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\">1 2 3 4 5 6"
                "</DataArray></Points></Piece></PolyData></VTKFile>\n",
                read);
    expectSound("table.csv", "time_s,id,x,y,z,radius,opacity\n0,1,0,0,0,1,0.2\n0,2,1,0,0,1,0.2\n1,2,1,3,0,2,0.2\n",
                read);
    expectSound("list.pvd",
                "<VTKFile type=\"Collection\"><Collection>\n<DataSet timestep=\"0\" part=\"0\" file=\"one.vtp\"/>\n"
                "</Collection></VTKFile>\n",
                read, folder.path());
    expectSound("list.series", R"({"file-series-version": "1.0", "files": [{"name": "one.vtp", "time": 0}]})", read,
                folder.path());
    expectSound("columns.toml", "position = [\"x\", \"y\", \"z\"]\nscale = 0.5\nradius = \"R\"\nup = \"z\"\n",
                [](const fs::path& file) { (void)world::DustColumns::parse(file.string()); });
}

TEST(Fuzz, Suites) {
    expectSound("suite.toml", bytesOf(data("suites/harness-same.toml")),
                [](const fs::path& file) { (void)suite::planRuns(suite::loadSuite(file.string(), false)); });
}

}  // namespace
}  // namespace dustbench::fuzz
