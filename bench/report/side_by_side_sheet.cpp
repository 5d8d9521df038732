#include "bench/report/side_by_side_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "bench/export/whole_file.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture_error.h"
#include "bench/report/drawing_program.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::report {
namespace fs = std::filesystem;
namespace {

/// A sheet with more columns is transposed, with methods as rows, if that makes it narrower.
constexpr std::size_t mostColumns = 9;

struct ShownPicture {
    pictures::Image picture;
    std::optional<measure::Plane> difference;  ///< from the reference image; empty if this run has none
    std::string caption;
};

struct Moment {
    std::string frame, timeSeconds;
    pictures::Image reference;
    std::vector<ShownPicture> pictures;  ///< one per run
};

std::string captionOf(const files::CsvTable& metrics, std::size_t row) {
    if (metrics.cell(row, "identical") == "1") return "identical";
    return fmt::format("PSNR {:.1f} dB  SSIM {:.3f}  FLIP {:.3f}", metrics.number(row, "psnr_db"),
                       metrics.number(row, "ssim"), metrics.number(row, "flip"));
}

pictures::Image readPicture(const results::ResultsFolder& results, const SheetRun& run, const std::string& frame,
                            const char* what) {
    const double number = files::numberOf(frame).value_or(-1);
    if (!(number >= 0 && number < 1e9))
        throw InputError(fmt::format("run '{}': metrics.csv has the frame '{}', expected a number", run.runId, frame));
    return pictures::readImage(results.runFolder(run.runId) / "images" /
                               fmt::format("f{:06}{}.exr", static_cast<std::int64_t>(number), what));
}

files::CsvTable metricsOfRun(const results::ResultsFolder& results, const SheetRun& run) {
    return files::CsvTable::parseFile(results.runFolder(run.runId) / "metrics.csv");
}

/// The rows of metrics.csv for frames with pictures; the others are only measured for popping.
std::vector<std::size_t> rowsWithPicture(const files::CsvTable& metrics) {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < metrics.rows(); ++row)
        if (!metrics.cell(row, "identical").empty()) rows.push_back(row);
    return rows;
}

std::vector<Moment> readReferences(const results::ResultsFolder& results, const SheetRun& run) {
    const files::CsvTable metrics = metricsOfRun(results, run);
    std::vector<Moment> moments;
    for (const std::size_t row : rowsWithPicture(metrics)) {
        const std::string& frame = metrics.cell(row, "frame");
        moments.push_back({frame,
                           fmt::format("{:.2f}", metrics.number(row, "time_s")),
                           readPicture(results, run, frame, "_reference"),
                           {}});
    }
    return moments;
}

void addEvaluated(const results::ResultsFolder& results, const SheetRun& run, std::vector<Moment>& moments) {
    const files::CsvTable metrics = metricsOfRun(results, run);
    std::size_t number = 0;
    for (const std::size_t row : rowsWithPicture(metrics)) {
        Moment& moment = moments.at(number++);
        pictures::Image picture = readPicture(results, run, metrics.cell(row, "frame"), "");
        measure::Plane difference = measure::flip(measure::preparePicture(moment.reference, "the reference"),
                                                  measure::preparePicture(picture, run.label))
                                        .map;
        moment.pictures.push_back({std::move(picture), std::move(difference), captionOf(metrics, row)});
    }
}

void addAsItIs(const results::ResultsFolder& results, const SheetRun& run, std::vector<Moment>& moments) {
    for (Moment& moment : moments)
        moment.pictures.push_back(
            {readPicture(results, run, moment.frame, ""), std::nullopt, "its own simulation:  no reference image"});
}

/// The maximum of all differences, rounded up to a tenth.
float scaleOf(const std::vector<Moment>& moments) {
    float maximum = 0;
    for (const Moment& moment : moments)
        for (const ShownPicture& picture : moment.pictures)
            if (picture.difference) maximum = std::max(maximum, *std::ranges::max_element(picture.difference->values));
    return std::max(0.1f, std::ceil(maximum * 10) / 10);
}

std::string headingOf(const Moment& moment) {
    return fmt::format("frame {}, {} s", moment.frame, moment.timeSeconds);
}

std::optional<SheetCell> differenceOf(const ShownPicture& picture, const SheetScale& scale) {
    if (!picture.difference) return std::nullopt;
    return SheetCell{measure::heatMap(*picture.difference, 0, scale.maximum), ""};
}

ContactSheet momentsAsRows(std::span<const SheetRun> runs, const std::vector<Moment>& moments) {
    ContactSheet sheet;
    sheet.scale = {0, scaleOf(moments), "FLIP"};
    sheet.columns.emplace_back("reference");
    for (const SheetRun& run : runs) sheet.columns.push_back(run.label);
    for (const SheetRun& run : runs)
        if (run.evaluated) sheet.columns.push_back("difference of " + run.label);
    for (const Moment& moment : moments) {
        sheet.rows.push_back(headingOf(moment));
        auto& cells = sheet.cells.emplace_back();
        cells.push_back(SheetCell{moment.reference, ""});
        for (const ShownPicture& picture : moment.pictures)
            cells.push_back(SheetCell{picture.picture, picture.caption});
        for (const ShownPicture& picture : moment.pictures)
            if (picture.difference) cells.push_back(differenceOf(picture, *sheet.scale));
    }
    return sheet;
}

ContactSheet methodsAsRows(std::span<const SheetRun> runs, const std::vector<Moment>& moments) {
    ContactSheet sheet;
    sheet.scale = {0, scaleOf(moments), "FLIP"};
    sheet.rows.emplace_back("reference");
    for (const SheetRun& run : runs) sheet.rows.push_back(run.label);
    sheet.cells.resize(sheet.rows.size());
    for (const Moment& moment : moments) {
        sheet.columns.insert(sheet.columns.end(), {headingOf(moment), "difference"});
        sheet.cells.front().insert(sheet.cells.front().end(), {SheetCell{moment.reference, ""}, std::nullopt});
        for (std::size_t run = 0; run < runs.size(); ++run) {
            const ShownPicture& picture = moment.pictures[run];
            sheet.cells[run + 1].push_back(SheetCell{picture.picture, picture.caption});
            sheet.cells[run + 1].push_back(differenceOf(picture, *sheet.scale));
        }
    }
    return sheet;
}

}  // namespace

ContactSheet sideBySideSheet(const results::ResultsFolder& results, std::span<const SheetRun> runs,
                             const std::string& title) {
    const auto firstEvaluated = std::ranges::find_if(runs, &SheetRun::evaluated);
    if (firstEvaluated == runs.end()) throw std::invalid_argument("contact sheet: no run has metrics");
    std::vector<Moment> moments = readReferences(results, *firstEvaluated);
    for (const SheetRun& run : runs)
        run.evaluated ? addEvaluated(results, run, moments) : addAsItIs(results, run, moments);
    const std::size_t columns =
        1 + runs.size() + static_cast<std::size_t>(std::ranges::count_if(runs, &SheetRun::evaluated));
    ContactSheet sheet = columns > mostColumns && 2 * moments.size() < columns ? methodsAsRows(runs, moments)
                                                                               : momentsAsRows(runs, moments);
    sheet.title = title;
    return sheet;
}

fs::path writeContactSheet(const ContactSheet& sheet, const fs::path& folder) {
    const fs::path file = folder / "contact_sheet.svg";
    exports::writeWhole(file, contactSheetSvg(sheet));
    return file;
}

fs::path drawContactSheet(const fs::path& folder) {
    const fs::path file = folder / "contact_sheet.png";
    exports::WholeFile drawn(file), log(file.string() + ".log");
    convertSvg(folder / "contact_sheet.svg", "png", 1, drawn.temporaryPath(), log.temporaryPath());
    drawn.publish();
    return file;
}

}  // namespace dustbench::report
