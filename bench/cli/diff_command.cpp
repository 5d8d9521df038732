// `dustbench diff`: the difference between an image file and a reference, in numbers and as a heat map.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/cli/commands.h"
#include "bench/cli/text_table.h"
#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/provenance.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

struct DiffOptions {
    std::string reference;
    std::string image;
    std::string out;
    double pixelsPerDegree = measure::defaultPixelsPerDegree;
    bool json = false;
};

struct Differences {
    measure::PictureError error;
    measure::Measured ssim, flip;
};

measure::Picture pictureOf(const std::string& file) {
    if (std::filesystem::is_directory(file)) throw InputError("image '" + file + "' cannot be read: it is a folder");
    return measure::preparePicture(pictures::readImage(file), "'" + file + "'");
}

/// Undefined values are `null`.
void printJson(const Differences& found) {
    using Json = nlohmann::ordered_json;
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    const Json object{{"psnr_db", number(found.error.psnrDb)},
                      {"ssim", number(found.ssim.value)},
                      {"flip", number(found.flip.value)},
                      {"rmse_linear", number(found.error.rmseLinear)},
                      {"identical", found.error.identical}};
    std::cout << object.dump(2) << '\n';
}

void printTable(const Differences& found, double pixelsPerDegree) {
    const auto cell = [](const std::optional<double>& value, int digits) {
        return value ? fixed(*value, digits) : std::string();
    };
    std::cout << textTable(
        {{"metric", "value", "meaning"},
         {"psnr_db", cell(found.error.psnrDb, 4), "higher is closer; none for identical pictures"},
         {"ssim", cell(found.ssim.value, 6), "1: same structure; none below 11x11 pixels"},
         {"flip", cell(found.flip.value, 6),
          fmt::format("0: no visible difference, 1: maximum; at {} pixels per degree", pixelsPerDegree)},
         {"rmse_linear", cell(found.error.rmseLinear, 6), "in linear light; 0: no difference"},
         {"identical", found.error.identical ? "1" : "0", "1: identical on a display"}});
}

int diff(const DiffOptions& options) {
    if (!options.out.empty() && std::filesystem::path(options.out).extension() != ".png")
        throw InputError("--out: got '" + options.out + "', allowed: a file that ends in .png");
    const files::InputLog read;
    const measure::Picture reference = pictureOf(options.reference), image = pictureOf(options.image);
    if (const std::string said = measure::saysIgnored(measure::ignoredParts(read.ignored())); !said.empty())
        std::cerr << "note: ignored: " << files::printable(said) << "\n";
    const Differences found{measure::pictureError(reference, image), measure::ssim(reference, image),
                            measure::flip(reference, image, options.pixelsPerDegree)};
    if (!options.out.empty()) pictures::writeImage(measure::heatMap(found.flip.map), options.out);
    if (options.json)
        printJson(found);
    else
        printTable(found, options.pixelsPerDegree);
    return exitOk;
}

}  // namespace

Command diffCommand() {
    auto options = std::make_shared<DiffOptions>();
    return {"diff", "PSNR, SSIM, FLIP and RMSE of an image file against a reference, and a heat map",
            "Reads all formats of OpenImageIO. Integers are sRGB and floats linear, unless the file states otherwise.\n"
            "Both images must be opaque and have the same size. Ignored parts of a file are listed on stderr.\n"
            "reports/METRICS.md defines the metrics.",
            [options](Arguments& arguments) {
                arguments.required("reference", "FILE", "the reference image", options->reference);
                arguments.required("image", "FILE", "the image to compare with it", options->image);
                arguments.flag("--json", "print JSON: psnr_db, ssim, flip, rmse_linear, identical", options->json);
                arguments.text("--out", "FILE.png", "write FLIP's error map: black for 0, pale yellow for 1",
                               options->out);
                arguments.number("--pixels-per-degree", "for FLIP: pixels per degree of the observer's field of view",
                                 options->pixelsPerDegree, measure::minimumPixelsPerDegree,
                                 measure::maximumPixelsPerDegree);
            },
            [options] { return diff(*options); }};
}

}  // namespace dustbench::cli
