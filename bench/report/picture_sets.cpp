#include "bench/report/picture_sets.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "bench/report/run_groups.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/pictures/picture_files.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

/// A picture file, compressed for the page.
struct SmallPicture {
    std::string mediaType;  ///< `image/png`, `image/jpeg`
    std::string bytes;
    int width = 0, height = 0;
};

/// Compression artefacts are invisible; metrics use the EXR files.
constexpr int jpegQuality = 80;

/// Red, green and blue of each pixel, as in the file.
std::vector<std::uint8_t> colourBytes(const pictures::StoredPicture& picture) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    std::vector<std::uint8_t> bytes;
    for (std::size_t pixel = 0; pixel < picture.values.size(); pixel += channels)
        for (std::size_t colour = 0; colour < 3; ++colour)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * picture.values[pixel + colour])));
    return bytes;
}

/// The unchanged file, or a JPEG if that is smaller. Throws InputError if it cannot be read.
SmallPicture makeSmall(const fs::path& png) {
    const pictures::PictureLibrary& library = pictures::pictureLibrary();
    pictures::StoredPicture picture;
    std::string fault = pictures::readPicture(png, picture);
    if (fault.empty() && picture.channels < 3) fault = "it has no colours";
    if (!fault.empty()) throw InputError("'" + png.string() + "': cannot be read as a picture: " + fault);

    SmallPicture small{"image/png", files::wholeText(png, "a picture", files::limits::geometryBytes), picture.width,
                       picture.height};
    std::vector<std::uint8_t> jpeg;
    // If JPEG encoding fails, the original file is used.
    if (library.encodeJpeg(picture.width, picture.height, colourBytes(picture), jpegQuality, jpeg).empty() &&
        jpeg.size() < small.bytes.size()) {
        small.mediaType = "image/jpeg";
        small.bytes.assign(jpeg.begin(), jpeg.end());
    }
    return small;
}

struct FramePictures {
    bool reference = false, difference = false;
};

/// Frames of which the run has pictures.
std::map<int, FramePictures> framesIn(const fs::path& images) {
    static const std::regex name("f(\\d{6,9})(_reference|_difference)?\\.png");
    std::map<int, FramePictures> frames;
    std::map<int, bool> pictured;
    std::error_code error;
    for (fs::directory_iterator entry(images, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        std::smatch match;
        const std::string file = entry->path().filename().string();
        if (!std::regex_match(file, match, name)) continue;
        FramePictures& frame = frames[std::stoi(match[1])];
        if (!match[2].matched) pictured[std::stoi(match[1])] = true;
        if (match[2] == "_reference") frame.reference = true;
        if (match[2] == "_difference") frame.difference = true;
    }
    std::erase_if(frames, [&pictured](const auto& frame) { return !pictured.contains(frame.first); });
    return frames;
}

using MetricsByFrame = std::map<int, PictureNumbers>;

/// The metrics of each frame in metrics.csv; empty if the run has no metrics or the file is damaged.
MetricsByFrame metricsOf(const fs::path& run) {
    MetricsByFrame byFrame;
    if (!fs::exists(run / "metrics.csv")) return byFrame;
    try {
        const auto table = files::CsvTable::parseFile(run / "metrics.csv");
        for (std::size_t row = 0; row < table.rows(); ++row)
            for (const char* column : {"psnr_db", "ssim", "flip"})
                if (!table.cell(row, column).empty())
                    byFrame[static_cast<int>(table.number(row, "frame"))][column] = table.number(row, column);
    } catch (const InputError&) {  // the pictures are shown without numbers
    }
    return byFrame;
}

class Collector {
 public:
    Collector(const fs::path& folder, std::int64_t maximumBytes, ReportData& data)
        : folder_(folder), bytesLeft_(maximumBytes), data_(data) {}

    void add(const RunGroup& group, const ReportCell& cell) {
        if (cell.done.empty()) return;
        const results::StoredRun& run = *cell.done.front();
        const std::string relative = "runs/" + run.runId + "/images/";
        const std::string label = variantLabel(group, cell);
        const bool wasPictured = run.cells.contains("FILE_image") && !run.cells.at("FILE_image").empty();
        const auto frames = framesIn(folder_ / relative);
        if (wasPictured && frames.empty() && missing_++ == 0) firstMissing_ = relative;
        const auto reference = run.cells.find("metric_reference");
        const bool isExact = reference == run.cells.end() || reference->second == "exact";
        const auto numbers = frames.empty() ? MetricsByFrame() : metricsOf(folder_ / "runs" / run.runId);
        for (const auto& [frame, has] : frames) {
            const auto found = numbers.find(frame);
            const PictureNumbers here = found == numbers.end() ? PictureNumbers() : found->second;
            PictureSet& set = setOf(group.id, worldLabel(group, cell), frame);
            const std::string start = fmt::format("{}f{:06}", relative, frame);
            if (has.reference) {
                // The ground truth is common to all methods; a finer setting is specific to its method.
                const std::string name = isExact ? "reference" : "reference of " + label;
                if (std::ranges::find(set.pictures, name, &ReportPicture::label) == set.pictures.end())
                    set.pictures.push_back({name, isExact ? "" : cell.method, false, start + "_reference.png", {}});
            }
            set.pictures.push_back({label, cell.method, false, start + ".png", here});
            if (has.difference) set.pictures.push_back({label, cell.method, true, start + "_difference.png", here});
        }
    }

    /// Embeds as many pictures as the limit allows; the others stay links.
    void embedAll() {
        for (PictureSet* set : byImportance()) {
            std::vector<ReportPicture> readable;
            for (ReportPicture& picture : set->pictures)
                if (embed(*set, picture)) readable.push_back(std::move(picture));
            set->pictures = std::move(readable);
        }
    }

    void noteMissing() const {
        if (missing_ > 0)
            data_.problems.push_back(fmt::format("the pictures of {} {} are missing, first in {}", missing_,
                                                 missing_ == 1 ? "run" : "runs", firstMissing_));
    }

 private:
    PictureSet& setOf(const std::string& group, const std::string& world, int frame) {
        for (PictureSet& set : data_.pictureSets)
            if (set.group == group && set.world == world && set.frame == frame) return set;
        return data_.pictureSets.emplace_back(PictureSet{group, world, frame, 0, 0, {}});
    }

    static double worstFlip(const PictureSet& set) {
        double worst = -1;
        for (const ReportPicture& picture : set.pictures)
            if (const auto flip = picture.numbers.find("flip"); flip != picture.numbers.end())
                worst = std::max(worst, flip->second);
        return worst;
    }

    /// The worst set of every group first, because the viewer opens with it, then all others in order.
    [[nodiscard]] std::vector<PictureSet*> byImportance() const {
        std::map<std::string, PictureSet*> worst;
        for (PictureSet& set : data_.pictureSets)
            if (PictureSet*& known = worst[set.group]; known == nullptr || worstFlip(set) > worstFlip(*known))
                known = &set;
        std::vector<PictureSet*> sets;
        for (PictureSet& set : data_.pictureSets)
            if (worst.at(set.group) == &set) sets.push_back(&set);
        for (PictureSet& set : data_.pictureSets)
            if (worst.at(set.group) != &set) sets.push_back(&set);
        return sets;
    }

    /// False if the picture cannot be read.
    bool embed(PictureSet& set, ReportPicture& picture) {
        try {
            if (bytesLeft_ > 0) {
                const SmallPicture small = makeSmall(folder_ / picture.source);
                set.width = small.width;
                set.height = small.height;
                const auto size = static_cast<std::int64_t>(small.bytes.size() * 4 / 3);
                if (size <= bytesLeft_) {
                    bytesLeft_ -= size;
                    picture.source = dataUrl(small.mediaType, small.bytes);
                    return true;
                }
                bytesLeft_ = 0;  // embedding smaller pictures later would leave confusing gaps
            }
            ++data_.linkedPictures;
            return true;
        } catch (const InputError& error) {
            data_.problems.push_back(fmt::format("picture left out: {}", error.what()));
            return false;
        }
    }

    const fs::path& folder_;
    std::int64_t bytesLeft_;
    ReportData& data_;
    std::size_t missing_ = 0;
    std::string firstMissing_;
};

}  // namespace

std::string dataUrl(std::string_view mediaType, std::string_view bytes) {
    std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): OpenSSL takes unsigned characters
    const int length =
        EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                        reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
    text.resize(static_cast<std::size_t>(length));
    return fmt::format("data:{};base64,{}", mediaType, text);
}

void collectPictures(const fs::path& folder, std::int64_t maximumBytes, ReportData& data) {
    Collector collector(folder, maximumBytes, data);
    for (const RunGroup& group : data.groups)
        for (const ReportCell& cell : group.cells) collector.add(group, cell);
    collector.embedAll();
    collector.noteMissing();
}

}  // namespace dustbench::report
