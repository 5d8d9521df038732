// End-to-end tests of `export` and `--volumes`: files, invalid input, and interruption.
#include <gmock/gmock.h>
#include <signal.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <chrono>
#include <map>
#include <thread>

#include "bench/cli/called_program.h"
#include "bench/results/run_record.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/maths/transmittance.h"

namespace dustbench::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr const char* shortWorld = "--method billboard --size 96x72 --warmup 2 -P preroll=0.2 -P particles=200";

class ExportCommand : public Dustbench {
 protected:
    [[nodiscard]] Called shortExport(const std::string& more, const std::string& to = "out") const {
        return call(fmt::format("export {} --out '{}' {}", shortWorld, (folder_ / to).string(), more));
    }
    [[nodiscard]] std::vector<std::string> names(const fs::path& folder) const {
        std::vector<std::string> list;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error)) list.push_back(entry.path().filename());
        return list;
    }
};

/// Time and file of each step, as found by VTK's XML parser.
std::map<std::string, double> stepsOf(const fs::path& pvd) {
    std::map<std::string, double> steps;
    vtkXMLDataElement* root = vtkXMLUtilities::ReadElementFromFile(pvd.c_str());
    if (!root) return steps;
    vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        double time = -1;
        collection->GetNestedElement(i)->GetScalarAttribute("timestep", time);
        steps[collection->GetNestedElement(i)->GetAttribute("file")] = time;
    }
    root->Delete();
    return steps;
}

/// ∫ extinction dV over the cells, and the corresponding sum over the particles of the same frame.
double gridMass(const fs::path& vti) {
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName(vti.c_str());
    reader->Update();
    vtkDataArray* extinction = reader->GetOutput()->GetCellData()->GetArray("extinction");
    if (!extinction) return -1;
    double sum = 0;
    for (vtkIdType i = 0; i < extinction->GetNumberOfTuples(); ++i) sum += extinction->GetTuple1(i);
    const double* spacing = reader->GetOutput()->GetSpacing();
    return sum * spacing[0] * spacing[1] * spacing[2];
}

double particleMass(const fs::path& vtp) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(vtp.c_str());
    reader->Update();
    vtkPointData* data = reader->GetOutput()->GetPointData();
    double sum = 0;
    for (vtkIdType i = 0; i < reader->GetOutput()->GetNumberOfPoints(); ++i)
        sum += maths::puffMassSquareMetres(data->GetArray("opacity")->GetTuple1(i),
                                           data->GetArray("radius")->GetTuple1(i));
    return sum;
}

TEST_F(ExportCommand, WritesTheSurfacesThatAMethodWearsWithTheirHeightsAndParticles) {
    const Called called =
        call(fmt::format("export --method relief --scene relief_wall --size 96x72 --warmup 150 -P preroll=1 "
                         "-P particles=3000 --frames 0:3:2 --format vtp --out '{}'",
                         (folder_ / "out").string()));
    ASSERT_EQ(called.code, 0) << called.err;
    const fs::path out = folder_ / "out";
    for (const char* part : {"relief_wall", "relief_sign"}) {
        EXPECT_EQ(stepsOf(out / fmt::format("{}.pvd", part)).size(), 2u) << part;
        EXPECT_TRUE(fs::exists(out / fmt::format("{}_heights.exr.series", part)));
        EXPECT_TRUE(fs::exists(out / fmt::format("f000002_{}_heights.exr", part)));
    }
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((out / "f000002_relief_wall.vtp").c_str());
    reader->Update();
    vtkPolyData& wall = *reader->GetOutput();
    vtkDataArray* hits = wall.GetPointData()->GetArray("hits");
    vtkDataArray* removed = wall.GetPointData()->GetArray("depth_removed");
    ASSERT_NE(hits, nullptr);
    double hitCount = 0, depthRemoved = 0;
    for (vtkIdType i = 0; i < wall.GetNumberOfPoints(); ++i) {
        hitCount += hits->GetTuple1(i);
        depthRemoved += removed->GetTuple1(i);
    }
    EXPECT_GT(hitCount, 0);
    EXPECT_GT(depthRemoved, 0);
    double bounds[6];
    wall.GetBounds(bounds);  // 4 m by 2 m around x = 8, on the ground behind z = −1.9
    EXPECT_NEAR(bounds[0], 6, 0.02);
    EXPECT_NEAR(bounds[1], 10, 0.02);
    EXPECT_NEAR(bounds[2], 0, 0.02);
    EXPECT_NEAR(bounds[3], 2, 0.02);
    EXPECT_LE(bounds[5], -1.9 + 1e-6);
    EXPECT_GE(bounds[4], -1.94 - 1e-6);
    EXPECT_EQ(stepsOf(out / "relief.pvd").size(), 2u);  // the particles: outside and within
}

TEST_F(ExportCommand, AMethodsOwnParticlesAreThoseOfTheSeries) {
    const fs::path out = folder_ / "rocket";
    const Called called = call(fmt::format(
        "export --method plugin_particles --scene plain -P system=rocket -P preroll=0.5 --warmup 1 --frames 2 --format "
        "vtp,vti --resolution 8 --out '{}'",
        out.string()));
    ASSERT_EQ(called.code, 0) << called.err;
    for (const char* series : {"particles.pvd", "plugin_particles.pvd"}) {
        const auto steps = stepsOf(out / series);
        ASSERT_EQ(steps.size(), 1u) << series;
        EXPECT_EQ(steps.begin()->first, "f000002_plugin_particles.vtp") << series;
    }
    EXPECT_EQ(stepsOf(out / "dust.pvd").begin()->first, "f000002.vtp");
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((out / "f000002_plugin_particles.vtp").c_str());
    reader->Update();
    vtkPolyData& cloud = *reader->GetOutput();
    vtkDataArray* const system = cloud.GetPointData()->GetArray("system");
    ASSERT_NE(system, nullptr);
    EXPECT_EQ(system->GetRange()[0], 1);
    EXPECT_EQ(system->GetRange()[1], 2);
    EXPECT_NE(cloud.GetPointData()->GetArray("colour"), nullptr) << "the systems have different colours";
    vtkAbstractArray* const method = cloud.GetFieldData()->GetAbstractArray("method");
    ASSERT_NE(method, nullptr);
    EXPECT_EQ(method->GetVariantValue(0).ToString(), "plugin_particles");
    vtkAbstractArray* const configuration = cloud.GetFieldData()->GetAbstractArray("configuration");
    std::vector<std::string> lines;
    for (vtkIdType i = 0; i < configuration->GetNumberOfValues(); ++i)
        lines.push_back(configuration->GetVariantValue(i).ToString());
    EXPECT_THAT(lines, IsSupersetOf({"scene=plain", "seed=1", "system=rocket", "light=none"}));
    EXPECT_NEAR(gridMass(out / "f000002.vti") / particleMass(out / "f000002_plugin_particles.vtp"), 1, 0.01);
}

TEST_F(ExportCommand, WritesEveryFrameAndSeriesWithTheSimulationsTimes) {
    const Called called = shortExport("--frames 0:9:4 --format vti,vtp,vdb --resolution 40 --region -5,-2,-5,9,4,5");
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_THAT(names(out()), testing::UnorderedElementsAre(
                                  "f000000.vti", "f000000.vtp", "f000000.vdb", "f000000.vtm", "scene", "f000004.vti",
                                  "f000004.vtp", "f000004.vdb", "f000004.vtm", "f000008.vti", "f000008.vtp",
                                  "f000008.vdb", "f000008.vtm", "extinction.pvd", "extinction.vti.series",
                                  "particles.pvd", "density.vdb.series", "scene.pvd", "export.json"));
    std::string series;
    for (const char* name :
         {"extinction.pvd", "extinction.vti.series", "density.vdb.series", "particles.pvd", "scene.pvd"})
        series += out() + "/" + name + "\n";
    EXPECT_EQ(called.out, series);
    for (const auto& [pvd, extension] :
         {std::pair("extinction.pvd", "vti"), {"particles.pvd", "vtp"}, {"scene.pvd", "vtm"}}) {
        const auto steps = stepsOf(fs::path(out()) / pvd);
        ASSERT_EQ(steps.size(), 3u);
        for (const int frame : {0, 4, 8})  // two warm-up frames precede frame 0; its state is that after its step
            EXPECT_DOUBLE_EQ(steps.at(fmt::format("f{:06}.{}", frame, extension)), (frame + 2 + 1) / 60.0);
    }
    const std::string check = fmt::format(
        "/usr/bin/python3 -c \"import json,sys; s=json.load(open(sys.argv[1])); assert "
        "s['file-series-version']=='1.0'; "
        "assert [f['name'] for f in s['files']]==['f000000.vti','f000004.vti','f000008.vti']; "
        "assert [round(f['time']*60) for f in s['files']]==[3,7,11]\" '{}/extinction.vti.series'",
        out());
    EXPECT_EQ(std::system(check.c_str()), 0);
}

TEST_F(ExportCommand, AnOctreeThatAccumulatesHasTheMassOfThePuffs) {
    const std::string world = " -P preroll=2 --warmup 2 --frames 0 --format vdb --vdb-precision float --out '";
    for (const char* method :
         {"billboard", "octree_recursive -P policy=accumulate", "octree_search -P policy=accumulate"}) {
        const std::string name = std::string(method).substr(0, std::string(method).find(' '));
        const Called called = call(std::string("export --method ") + method + world + (folder_ / name).string() + "'");
        ASSERT_EQ(called.code, 0) << called.err;
    }
    const std::string check = fmt::format(
        "/usr/bin/python3 -c \"\nimport pyopenvdb\ndef mass(name):\n"
        "    grid = pyopenvdb.read('{}/' + name + '/f000000.vdb', 'density')\n"
        "    return sum(v.value * v.count for v in grid.citerOnValues()) * grid.transform.voxelSize()[0] ** 3\n"
        "puffs, recursive, search = mass('billboard'), mass('octree_recursive'), mass('octree_search')\n"
        "assert puffs > 1, puffs\nassert abs(recursive / puffs - 1) < 0.01, recursive / puffs\n"
        "assert abs(search / recursive - 1) < 1e-6, search / recursive\n\"",
        folder_.string());
    EXPECT_EQ(std::system(check.c_str()), 0);
}

TEST_F(ExportCommand, SaysWhereGridsLieInDifferentPlaces) {
    const Called alone = shortExport("--frames 0");
    ASSERT_EQ(alone.code, 0);
    EXPECT_THAT(alone.err, testing::Not(HasSubstr("--region")));
    const Called called = shortExport("--frames 0:9:4");
    ASSERT_EQ(called.code, 0);
    EXPECT_THAT(names(out()), testing::Contains("extinction.vti.series"));
    EXPECT_EQ(called.out, out() + "/extinction.pvd\n" + out() + "/extinction.vti.series\n" + out() + "/scene.pvd\n");
    EXPECT_THAT(called.err, HasSubstr("(--region)"));
}

TEST_F(ExportCommand, TheGridHoldsTheMassOfTheParticles) {
    ASSERT_EQ(shortExport("--frames 30 --format vti,vtp").code, 0);
    const double particles = particleMass(fs::path(out()) / "f000030.vtp");
    EXPECT_GT(particles, 0);
    EXPECT_NEAR(gridMass(fs::path(out()) / "f000030.vti") / particles, 1, 0.01);
}

TEST_F(ExportCommand, HasTheVeryStateThatARunHasAtThatFrame) {
    const Called exported = shortExport("--frames 3:12:4 --format vti,vtp --resolution 30 --threads 1");
    ASSERT_EQ(exported.code, 0) << exported.err;
    const Called ran = call(fmt::format(
        "run {} --frames 12 --volumes 3:12:4 --format vti,vtp --resolution 30 --threads 2 --out '{}/runs-out'",
        shortWorld, folder_.string()));
    ASSERT_EQ(ran.code, 0) << ran.err;
    const fs::path run = runs((folder_ / "runs-out").string()).at(0);
    for (const char* name : {"f000003.vtp", "f000007.vtp", "f000011.vtp", "f000003.vti", "f000007.vti", "f000011.vti",
                             "extinction.pvd", "f000011/f000011_1.vtp"})
        EXPECT_EQ(contentOf(fs::path(out()) / name), contentOf(run / "volumes" / name)) << name;
    // The last frame's hash is the run's.
    const std::string text = contentOf(run / "run.json");
    const std::size_t at = text.find("\"state_hash\": \"");
    ASSERT_NE(at, std::string::npos);
    EXPECT_THAT(contentOf(fs::path(out()) / "export.json"), HasSubstr(text.substr(at, 31)));
    const auto summary = files::CsvTable::parseFile(folder_ / "runs-out" / "summary.csv");
    EXPECT_EQ(summary.cell(0, "FILE_volume"), "runs/" + run.filename().string() + "/volumes/extinction.pvd");
    EXPECT_TRUE(fs::exists(folder_ / "runs-out" / summary.cell(0, "FILE_volume")));
}

TEST_F(ExportCommand, WrongUseIsOneLineAndExitCodeThreeAndLeavesNothing) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"", "--frames"},
        {"--frames 5:1", "reversed"},
        {"--frames 5:5", "no frame"},
        {"--frames -3:5", "negative"},
        {"--frames 0:5:0", "step of 0"},
        {"--frames x", "A:B:STEP"},
        {"--frames 0 --format vti,obj", "vti, htg, vtp, vdb"},
        {"--frames 0 --resolution 2049", "1..2048"},
        {"--frames 0 --resolution 0", "1..2048"},
        {"--frames 0 --resolution 1.5", "'1.5'"},
        {"--frames 0 --resolution fine", "'fine'"},
        {"--frames 0 --region 0,0,0,1,1", "5 numbers"},
        {"--frames 0 --region 0,0,0,1,-1,1", "y1"},
        {"--frames 0 --region 0,0,0,1,1,inf", "outside"},
        {"--frames 0 --vdb-precision double", "half|float"},
        {"--frames 0 -P speed=10,20", "2 combinations"},
        {"--frames 0 -P speeed=10", "'speed'"},
        {"--frames 0 --scene plan", "'plain'"},
        {"--frames 100000", "drive 'straight'"},
    };
    for (const auto& [arguments, expected] : mistakes) {
        const Called called = shortExport(arguments);
        EXPECT_EQ(called.code, 3) << arguments << "\n" << called.err;
        EXPECT_THAT(called.err, HasSubstr(expected)) << arguments;
        const auto lines = std::ranges::count(called.err, '\n');
        EXPECT_LE(lines, called.err.starts_with("run 1 of 1") ? 2 : 1) << arguments << "\n" << called.err;
        EXPECT_EQ(called.out, "") << arguments;
        EXPECT_FALSE(fs::exists(out())) << arguments;
    }
}

TEST_F(ExportCommand, GoesToTheEndOfTheDriveAndNoFurther) {
    std::ofstream(folder_ / "short.csv") << "time_s,target_speed_mps,steer\n0,10,0\n0.5,10,0\n";
    const std::string drive = fmt::format("--drive '{}/short.csv' --format vtp --frames", folder_.string());
    const Called beyond = shortExport(drive + " 0:29:28");
    EXPECT_EQ(beyond.code, 3);
    EXPECT_THAT(beyond.err, AllOf(HasSubstr("frame 28"), HasSubstr("0.5 s"), HasSubstr("frames 0..27")));
    EXPECT_FALSE(fs::exists(out()));
    const Called last = shortExport(drive + " 27");
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_DOUBLE_EQ(stepsOf(fs::path(out()) / "particles.pvd").at("f000027.vtp"), 0.5);
    EXPECT_THAT(
        call(fmt::format("export --method billboard --warmup 40 --out '{}/none' {} 0", folder_.string(), drive)).err,
        HasSubstr("warm-up is longer"));
}

TEST_F(ExportCommand, AnOctreeIsNotToBeHadFromPuffs) {
    const Called called = shortExport("--frames 0 --format vti,htg");
    EXPECT_EQ(called.code, 3);
    EXPECT_THAT(called.err, HasSubstr("method billboard provides no octree; possible formats: vti,vtp,vdb"));
    EXPECT_FALSE(fs::exists(out()));
    // A suite requests the same formats from all methods: an unsupported one is omitted with a warning.
    const std::string run = fmt::format("run {} --frames 2 --volumes 0 --out '{}' ", shortWorld, out());
    const Called ran = call(run + "--format vtp,htg");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(contentOf(runs(out()).at(0) / "run.json"), HasSubstr("no .htg was written: method billboard"));
    EXPECT_THAT(names(runs(out()).at(0) / "volumes"), IsSupersetOf({"f000000.vtp", "particles.pvd"}));
    const Called nothing = call(run + "--format htg");
    EXPECT_EQ(nothing.code, 3);
    EXPECT_THAT(nothing.err, HasSubstr("possible formats"));
}

TEST_F(ExportCommand, AGridThatDoesNotFitIntoMemoryIsRefusedWithItsBytes) {
    for (const char* region : {"--region 0,0,0,1,1,1", "--region 0,0,0,1,1,1 --format vdb"}) {
        const std::string command =
            fmt::format("ulimit -v 8000000; '{}' export {} --frames 0 --resolution 2048 {} --out '{}' 2>'{}/said'",
                        DUSTBENCH_PROGRAM, shortWorld, region, out(), folder_.string());
        const int status = std::system(command.c_str());
        EXPECT_EQ(WEXITSTATUS(status), 3);
        EXPECT_THAT(contentOf(folder_ / "said"), AllOf(HasSubstr("2048x2048x2048"), HasSubstr("bytes")));
        EXPECT_FALSE(fs::exists(out()));
    }
}

TEST_F(ExportCommand, VolumesOfARunAreOfItsFrames) {
    const std::string run = fmt::format("run {} --frames 5 --out '{}' ", shortWorld, out());
    EXPECT_THAT(call(run + "--volumes 0:10:5").err, HasSubstr("frame 5 is beyond the run's end, allowed: frames 0..4"));
    EXPECT_THAT(call(run + "--format vti").err, HasSubstr("--format: given without --volumes"));
    EXPECT_EQ(call(run + "--region 0,0,0,1,1,1").code, 3);
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(ExportCommand, ASuiteWritesVolumesOfEveryRun) {
    std::ofstream(folder_ / "small.toml")
        << "title = \"small\"\nmethods = [\"billboard\"]\nsizes = [\"64x48\"]\n"
           "frames = 4\nwarmup = 0\nvolumes = \"0:4:2\"\nformats = [\"vtp\", \"vti\"]\n"
           "resolution = 16\nregion = \"-20,-2,-5,5,4,5\"\n"
           "[parameters]\npreroll = 0.2\nparticles = [50, 100]\n";
    const std::string suite = fmt::format("suite '{}/small.toml' --out '{}' ", folder_.string(), out());
    const Called called = call(suite);
    ASSERT_EQ(called.code, 0) << called.err;
    ASSERT_EQ(runs(out()).size(), 2u);
    for (const fs::path& run : runs(out()))
        EXPECT_THAT(names(run / "volumes"), IsSupersetOf({"f000000.vti", "f000002.vti", "f000002.vtp", "scene.pvd"}));
    // The command line takes precedence, so these are different runs.
    ASSERT_EQ(call(suite + "--volumes 1 --format vtp").code, 0);
    EXPECT_EQ(runs(out()).size(), 4u);
    EXPECT_THAT(call(suite + "--volumes 4").err, HasSubstr("allowed: frames 0..3"));
}

TEST_F(ExportCommand, AKilledExportLeavesOnlyWholeFiles) {
    const std::string last = fmt::format("{}/f000000.vtm", out());
    const pid_t victim = fork();
    if (victim == 0) {
        execl(DUSTBENCH_PROGRAM, DUSTBENCH_PROGRAM, "export", "--method", "billboard", "--size", "64x48", "-P",
              "preroll=0.2", "--frames", "0:400", "--format", "vti,vtp,vdb", "--resolution", "256", "--region",
              "-20,-2,-10,10,10,10", "--out", out().c_str(), nullptr);
        _exit(127);
    }
    for (int i = 0; i < 6'000 && !fs::exists(last); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(130));  // into a later frame
    kill(victim, SIGKILL);
    int status = 0;
    waitpid(victim, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_TRUE(fs::exists(last));

    int grids = 0;
    for (const std::string& name : names(out())) {
        if (name.starts_with('.')) continue;
        const fs::path file = fs::path(out()) / name;
        if (file.extension() == ".vti") {
            EXPECT_GE(gridMass(file), 0) << name;
            ++grids;
        }
        if (file.extension() != ".pvd") continue;
        for (const auto& [step, time] : stepsOf(file)) EXPECT_TRUE(fs::exists(fs::path(out()) / step)) << step;
    }
    EXPECT_GE(grids, 1);
    EXPECT_FALSE(fs::exists(fs::path(out()) / "export.json"));
    // The next export removes the leftovers.
    ASSERT_EQ(shortExport("--frames 0").code, 0);
    for (const std::string& name : names(out())) EXPECT_FALSE(name.starts_with('.')) << name;
}

TEST_F(ExportCommand, CtrlCEndsWithTwoAndLeavesOnlyWholeFiles) {
    const pid_t child = fork();
    if (child == 0) {
        execl(DUSTBENCH_PROGRAM, DUSTBENCH_PROGRAM, "export", "--method", "billboard", "--size", "64x48", "-P",
              "preroll=0.2", "--frames", "0:1000", "--out", out().c_str(), nullptr);
        _exit(127);
    }
    const fs::path series = fs::path(out()) / "extinction.pvd";
    for (int i = 0; i < 6'000 && !fs::exists(series); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    for (const std::string& name : names(out())) EXPECT_FALSE(name.starts_with('.')) << name;
    EXPECT_GE(stepsOf(series).size(), 1u);
}

}  // namespace
}  // namespace dustbench::cli
