#include "bench/run/comparison_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measure/image/flip.h"
#include "bench/measure/image/heat_map.h"
#include "methods/shared/files/csv.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

struct JudgedPicture {
    draw::Image picture;
    Plane difference;
    std::string caption;
};

struct Moment {
    std::string frame, timeSeconds;
    draw::Image reference;
    std::vector<JudgedPicture> pictures;  ///< one a run
};

std::string captionOf(const files::CsvTable& metrics, std::size_t row) {
    if (metrics.cell(row, "identical") == "1") return "identical";
    return fmt::format("PSNR {:.1f} dB  SSIM {:.3f}  FLIP {:.3f}", metrics.number(row, "psnr_db"),
                       metrics.number(row, "ssim"), metrics.number(row, "flip"));
}

std::vector<Moment> readMoments(const ResultsFolder& results, std::span<const SheetRun> runs) {
    std::vector<Moment> moments;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const fs::path folder = results.runFolder(runs[i].runId);
        const files::CsvTable metrics = files::CsvTable::parseFile(folder / "metrics.csv");
        std::size_t moment = 0;
        for (std::size_t row = 0; row < metrics.rows(); ++row) {
            if (metrics.cell(row, "identical").empty()) continue;  // of the popping stretch alone
            const auto image = [&](const char* what) {
                return draw::readImage(folder / "images" /
                                       fmt::format("f{:06.0f}{}.exr", metrics.number(row, "frame"), what));
            };
            if (i == 0)
                moments.push_back({metrics.cell(row, "frame"),
                                   fmt::format("{:.2f}", metrics.number(row, "time_s")),
                                   image("_reference"),
                                   {}});
            draw::Image picture = image("");
            Plane difference = flip(preparePicture(moments.at(moment).reference, "the reference"),
                                    preparePicture(picture, runs[i].label))
                                   .map;
            moments.at(moment++).pictures.push_back(
                {std::move(picture), std::move(difference), captionOf(metrics, row)});
        }
    }
    return moments;
}

/// The greatest difference of all, rounded up to a tenth.
float scaleOf(const std::vector<Moment>& moments) {
    float most = 0;
    for (const Moment& moment : moments)
        for (const JudgedPicture& picture : moment.pictures)
            most = std::max(most, *std::ranges::max_element(picture.difference.values));
    return std::max(0.1f, std::ceil(most * 10) / 10);
}

}  // namespace

ContactSheet comparisonSheet(const ResultsFolder& results, std::span<const SheetRun> runs, const std::string& title) {
    const std::vector<Moment> moments = readMoments(results, runs);
    ContactSheet sheet;
    sheet.title = title;
    sheet.scale = {0, scaleOf(moments), "FLIP"};
    sheet.columns.emplace_back("exact");
    for (const SheetRun& run : runs) sheet.columns.push_back(run.label);
    for (const SheetRun& run : runs) sheet.columns.push_back("difference of " + run.label);
    for (const Moment& moment : moments) {
        sheet.rows.push_back(fmt::format("frame {}, {} s", moment.frame, moment.timeSeconds));
        auto& cells = sheet.cells.emplace_back();
        cells.push_back(SheetCell{moment.reference, ""});
        for (const JudgedPicture& picture : moment.pictures)
            cells.push_back(SheetCell{picture.picture, picture.caption});
        for (const JudgedPicture& picture : moment.pictures)
            cells.push_back(SheetCell{heatMap(picture.difference, 0, sheet.scale->most), ""});
    }
    return sheet;
}

}  // namespace dustbench::bench
