// How a viewer composes its picture, describes it and saves it, with the other files of its state.
#include <fmt/format.h>

#include <algorithm>

#include "bench/export/volume_exporter.h"
#include "bench/export/whole_file.h"
#include "bench/view/viewer.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/read_back.h"

namespace dustbench::view {
namespace {

constexpr float minimumPixels = 8;  ///< minimum width and height of the visible part

std::string nameOf(const ViewState& state, Half half) {
    return fmt::format("{} {}", half == Half::a ? "A" : "B", view::half(state, half).method);
}

/// Every format that can store the volume; all of them if none can.
std::vector<std::string> formatsOf(const exports::CollectedVolume& volume) {
    std::vector<std::string> all, possible;
    for (const exports::Exporter& exporter : exports::exporters()) {
        all.push_back(exporter.id);
        if (exports::whyNotWritable(volume, exporter.id).empty()) possible.push_back(exporter.id);
    }
    return possible.empty() ? all : possible;
}

/// True if the view is light, which can be exposed again: not a comparison and not a map.
bool isLight(const SplitSettings& settings) {
    return settings.channel == Channel::picture && settings.shown != Shown::difference && settings.shown != Shown::flip;
}

/// What determines the half's state.
std::vector<std::string> configurationShown(ViewState state) {
    const std::string drive = state.drive;
    const bool byKeys = drive == keyboardDrive;  // no run can repeat that
    if (byKeys) state.drive.clear();
    std::vector<std::string> lines = results::configurationOf(runOf(state, Half::a));
    if (byKeys) lines.push_back("drive=" + drive);
    return lines;
}

}  // namespace

void Viewer::makeImage(Shown shown) {
    results::ImageSize size = session_.state().size;
    if (shown == Shown::sideBySide) size.width *= 2;
    if (image_.width() == size.width && image_.height() == size.height) return;
    image_ = gpu::Texture::make2D(device_, "view", gpu::Format::rgba8, size.width, size.height);
    target_ = gpu::Framebuffer(device_, "view", &image_, nullptr);
}

bool Viewer::draw() {
    const bool lacksExact = session_.isExact(Half::b) && !session_.isEvaluated() && paused;
    const results::ImageSize size = sizeNow();
    const PictureParts parts = partsNow();
    const bool isAsked = mustDraw_ || exactAsked_ || lacksExact || !(settingsNow() == composed_) ||
                         !(size == session_.drawnSize()) || !(parts == session_.drawnParts());
    const bool isDone = keepsPace && (drawShare < 1 || drawsOnlyShown) && nothingMoves();
    if ((drawingPaused || isDone) && !isAsked) return false;
    mustDraw_ = false;
    session_.draw(size, parts);
    attempt([&] { drawExact(); });
    attempt([&] { compose(settingsNow()); });
    return true;
}

/// Maps, their numbers and the ground truth are drawn at full size.
bool Viewer::isPaced() const {
    const bool isMap = split.shown == Shown::flip || split.channel == Channel::overdraw ||
                       split.channel == Channel::outlines || split.channel == Channel::faults;
    const bool isExact = session_.isExact(Half::b) && (exactEveryFrame || session_.isEvaluated());
    return keepsPace && !isMap && !isExact && !drawingPaused;
}

results::ImageSize Viewer::sizeNow() const {
    const results::ImageSize full = session_.state().size;
    return isPaced() && !nothingMoves() ? shareOf(full, drawShare) : full;
}

PictureParts Viewer::partsNow() const {
    return drawsOnlyShown && isPaced() && !nothingMoves() ? shownParts(settingsNow()) : PictureParts{};
}

void Viewer::drawAtFullSize() {
    if (session_.drawnSize() == session_.state().size && session_.drawnParts() == PictureParts{}) return;
    session_.draw();
    compose(settingsNow());
}

std::string Viewer::drawnRemark() const {
    const results::ImageSize drawn = session_.drawnSize(), full = session_.state().size;
    std::string how;
    if (!(drawn == full)) how = fmt::format(" at {}x{} of {}x{}", drawn.width, drawn.height, full.width, full.height);
    if (!(session_.drawnParts() == PictureParts{}))
        how += how.empty() ? " only where it is shown" : ", where it is shown,";
    return how.empty() ? "" : fmt::format("drawn{} to keep {} frames per second", how, pacedFramesPerSecond);
}

/// It may take seconds, so while the world or the camera moves, it is drawn only on request.
void Viewer::drawExact() {
    const bool isAtRest = paused && session_.drawnMoment() == momentBefore_;
    momentBefore_ = session_.drawnMoment();
    if (!session_.isExact(Half::b) || session_.isEvaluated() || session_.stepsToGo() > 0) return;
    if (isAtRest || exactEveryFrame || std::exchange(exactAsked_, false)) session_.drawExact();
}

Half Viewer::secondHalf() const {
    return session_.isCurrent(Half::b) ? Half::b : Half::a;
}

SplitSettings Viewer::settingsNow() const {
    SplitSettings settings = split;
    const bool both = secondHalf() == Half::b;
    if (!both) settings.shown = Shown::a;
    if (both && holds(Action::flip)) settings.shown = settings.shown == Shown::b ? Shown::a : Shown::b;
    return settings;
}

void Viewer::compose(const SplitSettings& settings) {
    const HalfTextures a = texturesOf(Half::a, settings), b = texturesOf(secondHalf(), settings);
    makeImage(settings.shown);
    splitView_.draw(a, b, settings, session_.view().camera.nearMetres, target_, image_.width(), image_.height());
    stamp_ = stampOf(settings);
    composed_ = settings;
}

HalfTextures Viewer::texturesOf(Half half, const SplitSettings& settings) {
    const HalfTextures drawn = session_.textures(half);
    if (settings.shown == Shown::flip) return {maps_.flip(session_), drawn.scene, drawn.layer, drawn.depth};
    if (settings.channel == Channel::overdraw)
        return {maps_.overdraw(session_, half), drawn.scene, drawn.layer, drawn.depth};
    if (settings.channel == Channel::outlines)
        return {maps_.outlines(session_, half), drawn.scene, drawn.layer, drawn.depth};
    return drawn;
}

std::string Viewer::stampOf(const SplitSettings& settings) const {
    const ViewState state = session_.state();
    const std::string a = nameOf(state, Half::a), b = state.b ? nameOf(state, Half::b) : "";
    std::string halves = a + " | " + b;
    if (settings.shown == Shown::a) halves = a;
    if (settings.shown == Shown::b) halves = b;
    if (settings.shown == Shown::difference) halves = fmt::format("{:g} x ({} - {})", settings.gain, b, a);
    if (settings.shown == Shown::flip) halves = fmt::format("FLIP of {} with reference {}", a, b);
    std::string text = fmt::format("frame {}: {}", session_.drawnFrame(), halves);
    if (settings.shown == Shown::flip) return text;
    if (settings.channel != Channel::picture) text += fmt::format(", {}", channelChoices.wordOf(settings.channel));
    if (settings.channel == Channel::picture && settings.stops != 0)
        text += fmt::format(", {:+.1f} stops", settings.stops);
    return text;
}

PixelValue Viewer::valueAt(glm::vec2 place) {
    const SplitSettings settings = settingsNow();
    const results::ImageSize size = session_.state().size;
    glm::vec2 at(place.x, 1 - place.y);
    bool isB = settings.shown == Shown::b || (settings.shown == Shown::wipe && at.x >= settings.divider);
    if (settings.shown == Shown::sideBySide) {
        isB = at.x >= 0.5f;
        at.x = glm::fract(2 * at.x);
    }
    const glm::ivec2 last(size.width - 1, size.height - 1);
    const glm::vec2 texel = (settings.origin + settings.extent * at) * glm::vec2(size.width, size.height);
    const glm::ivec2 pixel = glm::clamp(glm::ivec2(glm::floor(texel)), glm::ivec2(0), last);
    const Half half = isB ? Half::b : Half::a;
    SplitSettings light, display, alpha;
    light.encoded = false;
    alpha.channel = Channel::alpha;
    return {half,
            pixel.x,
            last.y - pixel.y,
            onePixel(half, pixel, light),
            onePixel(half, pixel, display),
            onePixel(half, pixel, alpha).r};
}

/// `pixel` counts from the lower left corner.
glm::vec3 Viewer::onePixel(Half half, glm::ivec2 pixel, const SplitSettings& settings) {
    const results::ImageSize size = session_.state().size;
    SplitSettings one = settings;
    one.shown = Shown::a;
    one.extent = 1.0f / glm::vec2(size.width, size.height);
    one.origin = glm::vec2(pixel) * one.extent;
    const HalfTextures drawn = session_.textures(half);
    splitView_.draw(drawn, drawn, one, session_.view().camera.nearMetres, pixelTarget_, 1, 1);
    return glm::vec3(draw::readBack(pixel_).pixels.front());
}

void Viewer::zoom(glm::vec2 place, double factor) {
    const results::ImageSize size = session_.state().size;
    const glm::vec2 at(split.shown == Shown::sideBySide ? glm::fract(2 * place.x) : place.x, 1 - place.y);
    const glm::vec2 minimum = glm::min(minimumPixels / glm::vec2(size.width, size.height), glm::vec2(1));
    const glm::vec2 fixed = split.origin + split.extent * at;
    const float extent = std::clamp(split.extent.x / static_cast<float>(factor), std::max(minimum.x, minimum.y), 1.0f);
    split.extent = glm::vec2(extent);
    split.origin = glm::clamp(fixed - split.extent * at, glm::vec2(0), 1.0f - split.extent);
}

void Viewer::pan(glm::vec2 shares) {
    split.origin =
        glm::clamp(split.origin - split.extent * glm::vec2(shares.x, -shares.y), glm::vec2(0), 1.0f - split.extent);
}

// --- The files that a viewer saves, and the command of its state

std::string Viewer::line(Half half) const {
    try {
        return commandLine(session_.state(), half, (folder_ / "run").string());
    } catch (const InputError& error) {
        return error.what();
    }
}

std::string Viewer::frameName() const {
    return fmt::format("f{:06}", std::max<std::int64_t>(session_.drawnFrame(), 0));
}

void Viewer::save(const std::string& name, const std::string& text) {
    std::filesystem::create_directories(folder_);
    exports::writeWhole(folder_ / name, text);
    message_ = "saved: " + (folder_ / name).string();
}

void Viewer::savePicture() {
    drawAtFullSize();
    std::filesystem::create_directories(folder_);
    const std::filesystem::path file = folder_ / (frameName() + ".png");
    pictures::writeImage(pictures::decoded(draw::readBack(image_)), file);
    message_ = "saved: " + file.string();
    if (!isLight(composed_)) return;
    const std::filesystem::path light = folder_ / (frameName() + ".exr");
    pictures::writeImage(lightOfImage(), light);
    message_ += ", " + light.string();
}

pictures::Image Viewer::lightOfImage() {
    SplitSettings settings = composed_;
    settings.encoded = false;
    settings.stops = 0;
    const gpu::Texture light =
        gpu::Texture::make2D(device_, "light of the view", gpu::Format::rgba32F, image_.width(), image_.height());
    const gpu::Framebuffer target(device_, "light of the view", &light, nullptr);
    splitView_.draw(session_.textures(Half::a), session_.textures(secondHalf()), settings,
                    session_.view().camera.nearMetres, target, image_.width(), image_.height());
    return draw::readBack(light);
}

void Viewer::saveVolume() {
    exports::CollectedVolume volume;
    session_.volume(Half::a, volume);
    const ViewState state = session_.state();
    exports::VolumeSettings settings;
    settings.frames = {session_.frame(), session_.frame(), 1};
    settings.formats = formatsOf(volume);
    exports::requireWritable(volume, settings.formats, state.a.method);
    const std::filesystem::path folder = folder_ / "volumes" / fmt::format("f{:06}", session_.frame());
    std::filesystem::create_directories(folder.parent_path());
    exports::VolumeExporter exporter(settings, folder);
    const world::World& world = session_.world();
    const std::vector<std::string> configuration = configurationShown(state);
    exporter.write(
        {session_.frame(), state.a.method, volume, world.scene(), world.state(), world.dust(), configuration});
    message_ = fmt::format("saved: {} ({})", folder.string(), exports::formatsText(settings.formats));
}

}  // namespace dustbench::view
