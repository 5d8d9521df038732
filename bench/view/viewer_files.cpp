// The files that a viewer saves, and the command of its state.
#include <fmt/format.h>

#include <algorithm>

#include "bench/export/volume_exporter.h"
#include "bench/export/whole_file.h"
#include "bench/view/viewer.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/read_back.h"

namespace dustbench::bench {
namespace {

/// Every format that can store the volume; all of them if none can.
std::vector<std::string> formatsOf(const CollectedVolume& volume) {
    std::vector<std::string> all, possible;
    for (const Exporter& exporter : exporters()) {
        all.push_back(exporter.id);
        if (whyNotWritable(volume, exporter.id).empty()) possible.push_back(exporter.id);
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
    std::vector<std::string> lines = configurationOf(runOf(state, Half::a));
    if (byKeys) lines.push_back("drive=" + drive);
    return lines;
}

}  // namespace

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
    writeWhole(folder_ / name, text);
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
    CollectedVolume volume;
    session_.volume(Half::a, volume);
    const ViewState state = session_.state();
    VolumeSettings settings;
    settings.frames = {session_.frame(), session_.frame(), 1};
    settings.formats = formatsOf(volume);
    requireWritable(volume, settings.formats, state.a.method);
    const std::filesystem::path folder = folder_ / "volumes" / fmt::format("f{:06}", session_.frame());
    std::filesystem::create_directories(folder.parent_path());
    VolumeExporter exporter(settings, folder);
    const World& world = session_.world();
    const std::vector<std::string> configuration = configurationShown(state);
    exporter.write(
        {session_.frame(), state.a.method, volume, world.scene(), world.state(), world.dust(), configuration});
    message_ = fmt::format("saved: {} ({})", folder.string(), formatsText(settings.formats));
}

}  // namespace dustbench::bench
