#include "bench/results/run_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "bench/results/results_folder.h"
#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::results {
namespace {

RunSpec spec() {
    RunSpec made;
    made.method = "haze";
    made.scene = "dir/with \"quotes\".toml";
    made.drive = "slalom";
    made.parameters = {{"sort", "radix"}, {"size", "0.1"}, {"tiny", "1e-07"}, {"count", "1000"}, {"soft", "on"}};
    made.seed = 1'234'567'890'123;
    made.threads = 2;
    made.sync = Sync::none;
    made.imagesEvery = 60;
    made.repetition = 3;
    return made;
}

TEST(RunRecord, SpecificationSurvivesItsFile) {
    EXPECT_EQ(canonicalKey(specFromJson(specToJson(spec()))), canonicalKey(spec()));
    EXPECT_EQ(runId(specFromJson(specToJson(spec()))), runId(spec()));
    RunSpec withVolumes = spec();
    withVolumes.volumes = exports::VolumeSettings{
        {2, 10, 4}, {"htg", "vdb"}, 77, exports::Box{{-1.5, 0.1, 2}, {3, 4, 5}}, {{"vdb_precision", "float"}}};
    EXPECT_EQ(canonicalKey(specFromJson(specToJson(withVolumes))), canonicalKey(withVolumes));
    EXPECT_NE(canonicalKey(withVolumes), canonicalKey(spec()));
    RunSpec withPath = spec();
    withPath.cameraPath = "0,1,2,3,4,5,6,50;2,1,2,9,4,5,6,50";
    EXPECT_EQ(canonicalKey(specFromJson(specToJson(withPath))), canonicalKey(withPath));
    EXPECT_NE(runId(withPath), runId(spec()));
    for (const DustOn place : {DustOn::cpu, DustOn::gpu, DustOn::automatic}) {
        RunSpec placed = spec();
        placed.dustOn = place;
        EXPECT_EQ(specFromJson(specToJson(placed)).dustOn, place);
    }
    EXPECT_THROW((void)specFromJson("{}"), InputError);
    EXPECT_THROW((void)specFromJson("not json"), InputError);
}

TEST(RunRecord, CellsSurviveTheFileAsTheyStandInTheTable) {
    RunRecord record;
    record.spec = spec();
    record.status = RunStatus::timeout;
    record.reason = "said \"no\",\nthen died\xff";  // with a byte that is not UTF-8
    record.summary = identityColumns(record, 2);
    record.summary.emplace_back("fps_avg", 59.94);
    record.summary.emplace_back("frame_ms_max", std::numeric_limits<double>::quiet_NaN());
    record.summary.emplace_back("cpu_bytes", std::int64_t{96'000'000'000});
    const auto file = std::filesystem::path(testing::TempDir()) / ("record-" + std::to_string(getpid()) + ".json");
    exports::writeWhole(file, toJson(record));
    const StoredRun run = readRunFile(file);
    EXPECT_EQ(run.runId, runId(record.spec));
    EXPECT_EQ(run.status, RunStatus::timeout);
    EXPECT_THAT(run.reason, testing::StartsWith("said \"no\",\nthen died"));
    EXPECT_EQ(run.parameters, record.spec.parameters);
    EXPECT_EQ(run.cells.at("fps_avg"), "59.94");
    EXPECT_EQ(run.cells.at("frame_ms_max"), "");
    EXPECT_EQ(run.cells.at("cpu_bytes"), "96000000000");
    EXPECT_EQ(run.cells.at("seed"), "1234567890123");
}

TEST(RunRecord, AStrangeFileIsNamed) {
    const auto file = std::filesystem::path(testing::TempDir()) / ("strange-" + std::to_string(getpid()) + ".json");
    exports::writeWhole(file, "{\"run_id\": 5}");
    try {
        (void)readRunFile(file);
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(file.string()));
    }
}

/// Writes a record in which `from` became `to`, and reads it.
StoredRun readChanged(const std::string& from, const std::string& to) {
    RunRecord record;
    record.spec = spec();
    record.summary = identityColumns(record, 2);
    record.summary.emplace_back("frame_ms_median", 12.5);
    record.provenance.warnings = {"short"};
    std::string text = toJson(record);
    const std::size_t at = text.rfind(from);
    EXPECT_NE(at, std::string::npos) << from;
    const auto file = std::filesystem::path(testing::TempDir()) / ("changed-" + std::to_string(getpid()) + ".json");
    exports::writeWhole(file, text.replace(at, from.size(), to));
    return readRunFile(file);
}

TEST(RunRecord, NumbersMustBeNumbers) {
    const auto refusal = [](const std::string& from, const std::string& to) {
        try {
            (void)readChanged(from, to);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("nothing thrown");
    };
    for (const char* text : {"\"abc\"", "\"1e999\"", "\"nan\"", "true", "\"12,5\""})
        EXPECT_THAT(refusal("12.5", text), testing::HasSubstr("summary.frame_ms_median: got '")) << text;
    EXPECT_THAT(refusal("\"repetition\": 3", "\"repetition\": 2147483647"),
                testing::HasSubstr("summary.repetition: got '2147483647', allowed: 1..1000"));
    for (const char* text : {"0", "-1", "1.5", "\"many\"", "1001"})
        EXPECT_THAT(refusal("\"repetition\": 3", std::string("\"repetition\": ") + text),
                    testing::HasSubstr("summary.repetition"))
            << text;
    EXPECT_EQ(readChanged("12.5", "1e-310").cells.at("frame_ms_median"), "1e-310");
    EXPECT_EQ(readChanged("12.5", "\"\"").cells.at("frame_ms_median"), "");
}

TEST(RunRecord, AnOlderRunHasItsDustWhereItsProvenanceSays) {
    const auto file = std::filesystem::path(testing::TempDir()) / ("older-" + std::to_string(getpid()) + ".json");
    RunRecord record;
    record.spec = spec();
    record.status = RunStatus::done;
    record.provenance.dustOn.place = "gpu";
    record.summary = identityColumns(record, 2);
    const auto placeIn = [&file](const std::string& text) {
        exports::writeWhole(file, text);
        return readRunFile(file).cells.at("dust_on");
    };
    const auto withoutProvenance = [](std::string text) {
        const std::string place = "\"dust_on\": \"gpu\"";
        return text.replace(text.find(place, text.find("\"provenance\"")), place.size(), "\"older\": \"\"");
    };
    EXPECT_EQ(placeIn(withoutProvenance(toJson(record))), "gpu") << "the summary has it";
    std::erase_if(record.summary, [](const auto& column) { return column.first == "dust_on"; });
    EXPECT_EQ(placeIn(toJson(record)), "gpu");
    EXPECT_EQ(placeIn(withoutProvenance(toJson(record))), "cpu");
}

TEST(RunRecord, OutputsSurviveTheFileAndStayBelowItsFolder) {
    RunRecord record;
    record.spec = spec();
    record.outputs = {{"frames.csv", 5'000'000'000, ""}, {"images/f000000.png", 7, std::string(64, 'a')}};
    const auto file = std::filesystem::path(testing::TempDir()) / ("outputs-" + std::to_string(getpid()) + ".json");
    const auto read = [&](const std::string& from = "", const std::string& to = "") {
        std::string text = toJson(record);
        if (!from.empty()) text.replace(text.find(from), from.size(), to);
        exports::writeWhole(file, text);
        return readRunFile(file);
    };
    const auto outputs = read().outputs;
    ASSERT_TRUE(outputs && outputs->size() == 2);
    EXPECT_EQ(outputs->at(0).bytes, 5'000'000'000u);
    EXPECT_EQ(outputs->at(0).sha256, "");
    EXPECT_EQ(outputs->at(1).file, "images/f000000.png");
    EXPECT_EQ(outputs->at(1).sha256, std::string(64, 'a'));
    for (const char* name : {"\"../frames.csv\"", "\"/dev/zero\"", "\"\"", "7", "null"})
        EXPECT_THROW((void)read("\"frames.csv\"", name), InputError) << name;
    EXPECT_THROW((void)read("5000000000", "-1"), InputError);
    // From an older build.
    EXPECT_FALSE(read("\"outputs\"", "\"others\"").outputs);
    record.outputs.reset();
    EXPECT_FALSE(read().outputs);
}

TEST(RunRecord, LongWarningsAreCut) {
    const StoredRun run = readChanged("\"short\"", '"' + std::string(50'000, '7') + '"');
    EXPECT_EQ(run.warnings.at(0), std::string(1000, '7') + " [50000 bytes in all]");
}

TEST(Summary, EveryMeasuredColumnIsOneOfTheTable) {
    RunRecord record;
    std::vector<std::string> known = columnsBeforeParameters();
    known.insert(known.end(), columnsAfterParameters().begin(), columnsAfterParameters().end());
    record.provenance.dustOn.place = "gpu";
    Columns columns = identityColumns(record, 1);
    EXPECT_THAT(columns, testing::Contains(Columns::value_type("dust_on", "gpu")));
    for (auto& column : measuredColumns({}, WholeRun())) columns.push_back(column);
    for (const auto& [name, value] : columns) EXPECT_THAT(known, testing::Contains(name));
}

TEST(Summary, SharesOfTheFrameAreMediansOfTheirColumns) {
    std::vector<measure::FrameRecord> frames(3);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].frame = static_cast<std::int64_t>(i);
        frames[i].frameMs = 10.0 + static_cast<double>(i);
        frames[i].stageMs.fill(1.0);
        frames[i].particles = 5;
    }
    WholeRun run;
    run.peakResidentBytes = 77;
    run.cpuJoules = 6;
    std::map<std::string, std::string> cells;
    for (const auto& [name, value] : measuredColumns(frames, run)) cells[name] = valueText(value);
    EXPECT_EQ(cells.at("frame_ms_median"), "11");
    EXPECT_EQ(cells.at("wait_ms_median"), "1");
    EXPECT_EQ(cells.at("harness_us_median"), "3000");
    EXPECT_EQ(cells.at("gpu_ms_median"), "");
    EXPECT_EQ(cells.at("particles_median"), "5");
    EXPECT_EQ(cells.at("rss_peak_bytes"), "77");
    EXPECT_EQ(cells.at("energy_cpu_j"), "2");
}

TEST(Summary, EnergyIsASumOnlyWhereEveryPartTells) {
    const std::vector<measure::FrameRecord> frames(2);
    const auto energy = [&](std::optional<double> cpu, std::optional<double> gpu, bool software) {
        WholeRun run;
        run.cpuJoules = cpu;
        run.gpuJoules = gpu;
        run.softwareRenderer = software;
        for (const auto& [name, value] : measuredColumns(frames, run))
            if (name == "energy_j") return valueText(value);
        return std::string("none");
    };
    EXPECT_EQ(energy(6, std::nullopt, true), "3");
    EXPECT_EQ(energy(6, std::nullopt, false), "none");
    EXPECT_EQ(energy(std::nullopt, 4, false), "none");
    EXPECT_EQ(energy(6, 4, false), "5");
}

TEST(FrameFiles, AreTablesOfOneRowAFrame) {
    std::vector<measure::FrameRecord> frames(2);
    frames[1].frame = 1;
    frames[1].frameMs = 0.1;
    frames[1].gpuMs = 2.5;
    frames[1].details = {{Stage::build, "advect, twice", 0.25}, {Stage::draw, "layer", 1}};
    const auto table = files::CsvTable::parseText(framesCsv(frames), "frames.csv");
    EXPECT_THAT(table.header(),
                testing::ElementsAre("frame", "time_s", "frame_ms", "input_ms", "simulate_ms", "build_ms", "sort_ms",
                                     "upload_ms", "scene_ms", "draw_ms", "wait_ms", "gpu_ms", "particles", "primitives",
                                     "cpu_bytes", "gpu_bytes", "rss_bytes"));
    ASSERT_EQ(table.rows(), 2u);
    EXPECT_EQ(table.cell(0, "gpu_ms"), "");
    EXPECT_EQ(table.number(1, "gpu_ms"), 2.5);
    const auto stages = files::CsvTable::parseText(stagesCsv(frames), "stages.csv");
    ASSERT_EQ(stages.rows(), 2u);
    EXPECT_EQ(stages.cell(0, "detail"), "advect, twice");
    EXPECT_EQ(stages.cell(0, "stage"), "build");
}

}  // namespace
}  // namespace dustbench::results
