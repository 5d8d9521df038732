#include "methods/plugin_particles/detail_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/maths/philox.h"
#include "methods/plugin_particles/seen_particles.h"
#include "methods/plugin_particles/system_picture.h"

namespace dustbench::plugin_particles::detail {
namespace {

constexpr int pictureWidth = 320, pictureHeight = 240;
constexpr float layerMetres = 6, farMetres = 300;

scene::View forwards() {
    scene::View view;
    view.width = pictureWidth;
    view.height = pictureHeight;
    view.camera.eye = {0, 2, 0};
    view.camera.target = {0, 2, -1};
    return view;
}

/// Uniform in a disc around the eye, at least 4 m away; colours change slowly with the place.
void fillLayer(particles::ParticleStore& store, std::uint64_t seed, std::size_t count) {
    store.keepOneColour(false);
    store.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto u = maths::uniform4(seed, 1, i);
        const float angle = 6.2831853f * u[0];
        const float distance = std::sqrt(16 + (farMetres * farMetres - 16) * u[1]);
        store.serial[i] = i;
        store.x[i] = distance * std::cos(angle), store.z[i] = distance * std::sin(angle),
        store.y[i] = layerMetres * u[2];
        store.velocityX[i] = store.velocityY[i] = store.velocityZ[i] = 0;
        store.age[i] = 1, store.lifetime[i] = 2;
        store.radius[i] = 0.4f, store.opacity[i] = 0.3f;
        store.red[i] = 0.5f + 0.4f * std::sin(store.x[i] / 20), store.green[i] = 0.5f;
        store.blue[i] = 0.5f + 0.4f * std::cos(store.z[i] / 20);
    }
}

class DetailCanvas {
 public:
    DetailCanvas(gpu::Device& device, std::uint64_t seed, std::size_t count)
        : device_(device), view_(forwards()), picture_(device, particles::Look(), {}) {
        depth_ = gpu::Texture::make2D(device, "no scene", gpu::Format::depth32F, pictureWidth, pictureHeight);
        depth_.write(std::span<const float>(std::vector<float>(pictureWidth * pictureHeight, 0.0f)));
        fillLayer(store_, seed, count);
    }

    struct Drawn {
        pictures::Image image;
        double seconds, share;
    };
    [[nodiscard]] Drawn draw(const Sight& sight) {
        constexpr float stepSeconds = 1.0f / 60;
        const auto begin = std::chrono::steady_clock::now();
        gpu::Layer layer(device_, depth_);
        layer.clear();
        const Puffs seen = seen_.of(store_, view_, particles::Look(), stepSeconds, sight);
        picture_.upload({seen, glm::vec3(view_.camera.eye), stepSeconds}, StageClock());
        picture_.draw(view_, layer);
        pictures::Image image = draw::readBack(layer.colour());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        return {std::move(image), took.count(), static_cast<double>(seen.size()) / static_cast<double>(store_.size())};
    }

 private:
    gpu::Device& device_;
    scene::View view_;
    gpu::Texture depth_;
    MemoryLedger ledger_;
    particles::ParticleStore store_{ledger_};
    SeenParticles seen_;
    SystemPicture picture_;
};

double farthestApart(const pictures::Image& a, const pictures::Image& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a.pixels[i][c] - b.pixels[i][c]));
    return static_cast<double>(largest);
}

double rootMeanSquare(const pictures::Image& a, const pictures::Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) sum += std::pow(static_cast<double>(a.pixels[i][c] - b.pixels[i][c]), 2);
    return std::sqrt(sum / (3 * static_cast<double>(a.pixels.size())));
}

double sumOfAlpha(const pictures::Image& image) {
    double sum = 0;
    for (const glm::vec4& pixel : image.pixels) sum += static_cast<double>(pixel.a);
    return sum;
}

Finding single(std::string quantity, double value) {
    return {std::move(quantity), value, value, value, pictureWidth * pictureHeight};
}

}  // namespace

std::vector<Finding> measureDetail(gpu::Device& device, std::uint64_t seed, std::size_t particles, int repetitions) {
    DetailCanvas canvas(device, seed, particles);
    const std::vector<float> details{1, 2, 4, 8};
    (void)canvas.draw({});  // the first one allocates
    std::vector<double> again, culled;
    std::vector<std::vector<double>> times(details.size());
    for (int k = 0; k < repetitions; ++k) {
        const double all = canvas.draw({}).seconds, alone = canvas.draw({true, 0}).seconds;
        again.push_back(canvas.draw({}).seconds / all);
        culled.push_back(alone / all);
        for (std::size_t d = 0; d < details.size(); ++d)
            times[d].push_back(canvas.draw({true, details[d]}).seconds / alone);
    }
    const auto all = canvas.draw({}), alone = canvas.draw({true, 0});
    std::vector<Finding> found{single("culled_share", alone.share), findings::medianOf("culled_time", culled),
                               single("culled_difference", farthestApart(all.image, alone.image)),
                               findings::medianOf("time_of_equals", again)};
    for (std::size_t d = 0; d < details.size(); ++d) {
        const auto name = [&](const char* what) { return fmt::format("detail_{:.0f}_{}", details[d], what); };
        const auto thin = canvas.draw({true, details[d]});
        found.push_back(single(name("share"), thin.share / alone.share));
        found.push_back(findings::medianOf(name("time"), times[d]));
        found.push_back(single(name("rms"), rootMeanSquare(thin.image, alone.image)));
        found.push_back(single(name("depth"), sumOfAlpha(thin.image) / sumOfAlpha(alone.image)));
    }
    return found;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures what culling and level of detail of particles save, and the error that they make.";
    info.source = "Thesis";
    info.run = [](ExperimentContext& context) {
        return measureDetail(context.device(), context.seed(), 60'000, context.quick() ? 5 : 15);
    };
    return info;
}

}  // namespace dustbench::plugin_particles::detail
