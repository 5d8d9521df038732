#include "bench/reference/reference_store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/measure/sha256.h"

namespace dustbench::reference {
namespace fs = std::filesystem;
namespace {

/// Adds values with their lengths, so that no two lists of inputs have the same bytes.
class InputDigest {
 public:
    template <typename Number>
    void add(std::span<const Number> numbers) {
        static_assert(std::is_arithmetic_v<Number>);
        addBytes(numbers.size_bytes());
        digest_.add({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
    }
    void add(double number) { add(std::span<const double>(&number, 1)); }
    void add(const glm::dvec3& vector) { add(std::span<const double>(&vector.x, 3)); }
    [[nodiscard]] std::string text() { return digest_.text(); }

 private:
    void addBytes(std::size_t count) { digest_.add({reinterpret_cast<const char*>(&count), sizeof count}); }

    measure::Sha256 digest_;
};

void addDust(InputDigest& digest, const Puffs& dust) {
    digest.add(dust.serial);
    for (const auto& column : {dust.x, dust.y, dust.z, dust.velocityX, dust.velocityY, dust.velocityZ, dust.age,
                               dust.lifetime, dust.radius, dust.opacity, dust.red, dust.green, dust.blue})
        digest.add(column);
    digest.add(dust.uniformColour ? 1 : 0);
    digest.add(glm::dvec3(dust.colourOfAll));
}

void addView(InputDigest& digest, const scene::View& view) {
    for (const glm::dvec3& vector : {view.camera.eye, view.camera.target, view.camera.up}) digest.add(vector);
    digest.add(view.camera.verticalFieldOfView);
    digest.add(view.camera.nearMetres);
    digest.add(view.width);
    digest.add(view.height);
}

void addLight(InputDigest& digest, const std::optional<SunLight>& light) {
    digest.add(light ? 1 : 0);
    if (!light) return;
    for (const glm::dvec3& vector : {light->toSun, light->sun, light->ambient}) digest.add(vector);
    digest.add(light->asymmetry);
    digest.add(light->albedo ? 1 : 0);
    if (light->albedo) digest.add(*light->albedo);
}

void addOptions(InputDigest& digest, const ReferenceOptions& options) {
    digest.add(options.opticalDepthShare);
    digest.add(options.ignoreScene ? 1 : 0);
    digest.add(options.toleratedDepth);
    digest.add(options.slabMetres);
}

std::uintmax_t bytesOf(const scene::View& view) {
    return static_cast<std::uintmax_t>(view.width) * static_cast<std::uintmax_t>(view.height) * sizeof(glm::vec4);
}

}  // namespace

ReferenceStore::ReferenceStore(fs::path folder, std::uintmax_t maximumBytes)
    : folder_(std::move(folder)), maximumBytes_(maximumBytes) {}

pictures::Image ReferenceStore::render(const Puffs& dust, const scene::View& view, const OpaqueDistances& distances,
                                       const std::optional<SunLight>& light, const ReferenceOptions& options) {
    std::string key;
    if (!folder_.empty()) {
        InputDigest digest;
        addDust(digest, dust);
        addView(digest, view);
        digest.add(std::span<const double>(distances.metres));
        addLight(digest, light);
        addOptions(digest, options);
        key = digest.text();
        if (std::optional<pictures::Image> stored = read(key, view)) {
            ++found_;
            return std::move(*stored);
        }
    }
    pictures::Image image = light ? renderLitParticles(dust, view, distances, *light, options).image
                                  : renderParticles(dust, view, distances, options).image;
    if (!folder_.empty()) write(key, image);
    return image;
}

/// Files appear by a rename, so one with the right length is complete.
std::optional<pictures::Image> ReferenceStore::read(const std::string& key, const scene::View& view) const {
    std::error_code error;
    if (fs::file_size(folder_ / key, error) != bytesOf(view) || error) return std::nullopt;
    pictures::Image image{view.width, view.height, {}};
    image.pixels.resize(bytesOf(view) / sizeof(glm::vec4));
    std::ifstream stream(folder_ / key, std::ios::binary);
    stream.read(reinterpret_cast<char*>(image.pixels.data()), static_cast<std::streamsize>(bytesOf(view)));
    return stream ? std::optional(std::move(image)) : std::nullopt;
}

void ReferenceStore::write(const std::string& key, const pictures::Image& image) {
    const std::uintmax_t bytes = image.pixels.size() * sizeof(glm::vec4);
    std::error_code error;
    fs::create_directories(folder_, error);
    const fs::space_info disk = fs::space(folder_, error);
    if (error || bytes > maximumBytes_ || disk.available < bytes + maximumBytes_) return;
    const fs::path unfinished = folder_ / fmt::format(".{}-{}", key, getpid());
    {
        std::ofstream stream(unfinished, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(image.pixels.data()), static_cast<std::streamsize>(bytes));
        stream.close();
        if (!stream) {
            fs::remove(unfinished, error);
            return;
        }
    }
    fs::rename(unfinished, folder_ / key, error);
    if (storedBytes_) *storedBytes_ += bytes;
    if (!storedBytes_ || *storedBytes_ > maximumBytes_) makeRoom();
}

/// Counts the folder's bytes and removes the oldest files if there are too many.
void ReferenceStore::makeRoom() {
    struct Stored {
        fs::file_time_type written;
        std::uintmax_t bytes;
        fs::path file;
    };
    std::vector<Stored> all;
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_, error)) {
        const std::uintmax_t fileBytes = entry.file_size(error);
        if (error) continue;  // another process has removed it
        all.push_back({entry.last_write_time(error), fileBytes, entry.path()});
        bytes += fileBytes;
    }
    std::ranges::sort(all, {}, &Stored::written);
    for (const Stored& stored : all) {
        if (bytes <= maximumBytes_) break;
        fs::remove(stored.file, error);
        bytes -= stored.bytes;
    }
    storedBytes_ = bytes;
}

}  // namespace dustbench::reference
