#include "methods/plugin_particles/brightness_experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/plugin_particles/system_picture.h"

namespace dustbench::plugin_particles::brightness {
namespace {

constexpr int width = 160, height = 120;
constexpr float distance = 10;
constexpr int directions = 100;
constexpr std::size_t points = 400;
constexpr float stepSeconds = 1.0f / 60;

/// Particles in front of an eye that looks along −Z.
class Canvas {
 public:
    explicit Canvas(gpu::Device& device) : device_(device), store(ledger_) {
        view_.width = width;
        view_.height = height;
        view_.camera.eye = {0, 0, 0};
        view_.camera.target = {0, 0, -1};
        depth_ = gpu::Texture::make2D(device, "no scene", gpu::Format::depth32F, width, height);
        depth_.write(std::span<const float>(std::vector<float>(width * height, 0.0f)));
        store.keepOneColour(false);
    }

    void put(std::size_t i, const glm::vec3& place, const glm::vec3& velocity, const glm::vec3& colour, float opacity) {
        store.serial[i] = i;
        store.x[i] = place.x, store.y[i] = place.y, store.z[i] = place.z;
        store.velocityX[i] = velocity.x, store.velocityY[i] = velocity.y, store.velocityZ[i] = velocity.z;
        store.red[i] = colour.r, store.green[i] = colour.g, store.blue[i] = colour.b;
        store.radius[i] = 0.1f, store.opacity[i] = opacity, store.age[i] = 1, store.lifetime[i] = 2;
    }
    [[nodiscard]] pictures::Image drawn(const char* part, const particles::NamedValues& values, bool sorted = true) {
        const particles::Look look =
            particles::makePartOf<particles::RenderPart>(particles::PartKind::render, part, values)->look();
        gpu::Layer layer(device_, depth_);
        layer.clear();
        if (sorted) {
            SystemPicture picture(device_, look, {});
            picture.upload({store, glm::vec3(0), stepSeconds}, StageClock());
            picture.draw(view_, layer);
        } else {
            const auto pass = makePass(device_, look, {});
            pass->upload({store, {}, stepSeconds});
            pass->draw(view_, layer);
        }
        return draw::readBack(layer.colour());
    }
    /// Converts pixels at the distance of the particles to metres.
    [[nodiscard]] float metresOf(float pixels) const {
        return pixels * distance / (view_.eyeToClip()[1][1] * height / 2);
    }

 private:
    gpu::Device& device_;
    scene::View view_;
    gpu::Texture depth_;
    MemoryLedger ledger_;

 public:
    particles::ParticleStore store;
};

double lightOf(const pictures::Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0,
                           [](double sum, const glm::vec4& pixel) { return sum + static_cast<double>(pixel.r); });
}

double largestDifference(const pictures::Image& a, const pictures::Image& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
    return static_cast<double>(largest);
}

/// On a display that clips at 1: min(1, C + (1 − α)·1) against 1.
double contrastOnWhite(const pictures::Image& layer) {
    float largest = 0;
    for (const glm::vec4& pixel : layer.pixels)
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(std::min(pixel[c] + 1 - pixel.a, 1.0f) - 1));
    return static_cast<double>(largest);
}

Finding lightAtFourTimes(const char* quantity, const char* part, gpu::Device& device, std::uint64_t seed) {
    Canvas canvas(device);
    canvas.store.resize(1);
    std::vector<double> ratios;
    for (int k = 0; k < directions; ++k) {
        const auto u = maths::uniform4(seed, 1, static_cast<std::uint64_t>(k));
        const float angle = 2 * std::numbers::pi_v<float> * u[0];
        const auto lightAt = [&](float pixels) {
            const float speed = canvas.metresOf(pixels) / stepSeconds;
            canvas.put(0, {u[1] - 0.5f, u[2] - 0.5f, -distance}, {speed * std::cos(angle), speed * std::sin(angle), 0},
                       glm::vec3(1), 0.5f);
            return lightOf(canvas.drawn(part, {}));
        };
        ratios.push_back(lightAt(40) / lightAt(10));
    }
    return findings::meanOf(quantity, ratios);
}

/// Places the same points, in reversed order if `reversed`.
void scatter(Canvas& canvas, std::uint64_t seed, bool reversed) {
    canvas.store.resize(points);
    for (std::size_t k = 0; k < points; ++k) {
        const auto place = maths::uniform4(seed, 2, k), colour = maths::uniform4(seed, 3, k);
        canvas.put(reversed ? points - 1 - k : k,
                   {6 * (place[0] - 0.5f), 6 * (place[1] - 0.5f), -distance - 4 * place[2]}, glm::vec3(0),
                   {colour[0], colour[1], colour[2]}, 0.5f);
    }
}

Finding exactly(const char* quantity, double value) {
    return {quantity, value, value, value, width * height};
}

Finding shuffled(const char* quantity, const particles::NamedValues& values, bool sorted, gpu::Device& device,
                 std::uint64_t seed) {
    Canvas one(device), other(device);
    scatter(one, seed, false);
    scatter(other, seed, true);
    return exactly(quantity,
                   largestDifference(one.drawn("points", values, sorted), other.drawn("points", values, sorted)));
}

Finding onWhite(const char* quantity, const particles::NamedValues& values, gpu::Device& device, std::uint64_t seed) {
    Canvas canvas(device);
    scatter(canvas, seed, false);
    return exactly(quantity, contrastOnWhite(canvas.drawn("points", values)));
}

}  // namespace

std::vector<Finding> measureBrightness(gpu::Device& device, std::uint64_t seed) {
    const particles::NamedValues wide{{"pixels", "8"}}, unclamped{{"pixels", "8"}, {"clamped", "off"}},
        alpha{{"pixels", "8"}, {"blend", "alpha"}};
    return {lightAtFourTimes("point_light_4x", "points", device, seed),
            lightAtFourTimes("line_light_4x", "lines", device, seed),
            lightAtFourTimes("hybrid_light_4x", "hybrid", device, seed),
            shuffled("shuffled_additive", unclamped, true, device, seed),
            shuffled("shuffled_clamped", wide, true, device, seed),
            shuffled("shuffled_alpha", alpha, false, device, seed),
            onWhite("contrast_white_additive", wide, device, seed),
            onWhite("contrast_white_alpha", alpha, device, seed)};
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary =
        "Measures how drawing methods affect brightness: fast lines, order of additive light, white backgrounds.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) { return measureBrightness(context.device(), context.seed()); };
    return info;
}

}  // namespace dustbench::plugin_particles::brightness
