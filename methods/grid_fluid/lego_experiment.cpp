#include "methods/grid_fluid/lego_experiment.h"

#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "methods/grid_fluid/fire_experiment.h"
#include "methods/kit/draw/read_back.h"
#include "methods/kit/findings/findings.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/raycast/grid_raycast.h"

namespace dustbench::grid_fluid::lego {
namespace {

using fire::Flake, fire::widthMetres;

/// From here a cell's front and back differ by a tenth of a pixel at the picture's rim.
constexpr double awayMetres = 400;

/// Wide enough for linear interpolation between cells to represent them.
std::vector<Flake> cloudOf(int cells, std::uint64_t seed) {
    constexpr int gaussians = 12;
    std::vector<Flake> cloud = fire::scatter(gaussians, 0, seed);
    for (std::uint64_t i = 0; i < gaussians; ++i) {
        const auto random = maths::uniform4(seed, 4, i);
        cloud[i].deviation = (1.2 + 1.2 * static_cast<double>(random[0])) * widthMetres / cells;
        cloud[i].depth = 0.2 + 0.6 * static_cast<double>(random[1]);
    }
    return cloud;
}

scene::View viewOfBox(int cells) {
    scene::View view;
    view.width = cells * pixelsPerCell;
    view.height = 2 * view.width;
    view.camera.eye = {widthMetres / 2, widthMetres, widthMetres / 2 + awayMetres};
    view.camera.target = {widthMetres / 2, widthMetres, widthMetres / 2};
    view.camera.verticalFieldOfView = 2 * std::atan(widthMetres / awayMetres);
    view.camera.nearMetres = 1;
    return view;
}

pictures::Image exactPicture(const std::vector<Flake>& cloud, const scene::View& view) {
    pictures::Image image{view.width, view.height, {}};
    const double edge = widthMetres / view.width;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec2 place = edge * glm::dvec2(x + 0.5, view.height - y - 0.5);
            double depth = 0;
            for (const Flake& flake : cloud) {
                const glm::dvec2 apart = (place - glm::dvec2(flake.centre)) / flake.deviation;
                depth += flake.depth * std::exp(-glm::dot(apart, apart) / 2);
            }
            image.pixels.emplace_back(0, 0, 0, static_cast<float>(-std::expm1(-depth)));
        }
    return image;
}

pictures::Image castPicture(gpu::Device& device, raycast::RaycastSettings settings, const fire::FireGrid& grid,
                            const scene::View& view) {
    gpu::Texture depth = gpu::Texture::make2D(device, "lego: depth", gpu::Format::depth32F, view.width, view.height);
    const std::vector<float> nothing(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
    depth.write(std::span<const float>(nothing));
    gpu::Layer layer(device, depth);
    layer.clear();
    settings.stopAlpha = 1;
    settings.extinctionPerMetre = fire::extinctionPerMetre;
    MemoryLedger ledger;
    raycast::GridRaycast raycast(device, settings, scene::Lights(), ledger);
    raycast.upload({{grid.cells, 2 * grid.cells, grid.cells}, grid.spacingMetres(), {0, 0, 0}, grid.density, {}});
    raycast.draw(view, layer);
    return draw::readBack(layer.colour());
}

}  // namespace

double blocksOf(const pictures::Image& picture, const pictures::Image& exact) {
    double added = 0, own = 0;
    const auto compare = [&](int x, int y, int beyondX, int beyondY) {
        const auto change = [&](const pictures::Image& image) {
            return static_cast<double>(image.at(beyondX, beyondY).a) - static_cast<double>(image.at(x, y).a);
        };
        added += std::pow(change(picture) - change(exact), 2);
        own += std::pow(change(exact), 2);
    };
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            if ((x + 1) % pixelsPerCell == 0 && x + 1 < picture.width) compare(x, y, x + 1, y);
            if ((y + 1) % pixelsPerCell == 0 && y + 1 < picture.height) compare(x, y, x, y + 1);
        }
    return std::sqrt(added / own);
}

double blocksSeen(gpu::Device& device, const raycast::RaycastSettings& settings, int cells, std::uint64_t seed) {
    const std::vector<Flake> cloud = cloudOf(cells, seed);
    const scene::View view = viewOfBox(cells);
    return blocksOf(castPicture(device, settings, fire::gridOf(cloud, cells), view), exactPicture(cloud, view));
}

namespace {

struct Way {
    const char* name;
    raycast::Filter filter;
    bool jitter;
    double stepCells;
};

std::vector<Finding> blocksByTreatment(ExperimentContext& context) {
    using raycast::Filter;
    const int cells = context.quick() ? 16 : 24, clouds = context.quick() ? 5 : 12;
    std::map<std::string, std::vector<double>> found;  // logarithms
    for (const auto& [backendName, backend] : {std::pair{"_gl", raycast::Backend::gl}, {"_cpu", raycast::Backend::cpu}})
        for (int cloud = 0; cloud < clouds; ++cloud) {
            double nearest = 0;
            for (const Way& way :
                 {Way{"nearest", Filter::nearest, false, 0.5}, Way{"linear", Filter::linear, false, 0.5},
                  Way{"cubic", Filter::cubic, false, 0.5}, Way{"jitter", Filter::nearest, true, 0.5},
                  Way{"finer", Filter::nearest, false, 1.0 / 16}, Way{"coarser", Filter::nearest, false, 1}}) {
                raycast::RaycastSettings settings;
                settings.backend = backend;
                settings.filter = way.filter;
                settings.jitter = way.jitter;
                settings.stepCells = way.stepCells;
                const double blocks = std::log(blocksSeen(context.device(), settings, cells,
                                                          1000 * context.seed() + static_cast<std::uint64_t>(cloud)));
                const std::string name = std::string(way.name) + backendName;
                if (!way.jitter && way.stepCells == 0.5) found["blocks_" + name].push_back(blocks);
                if (way.filter == Filter::nearest && name.starts_with("nearest"))
                    nearest = blocks;
                else
                    found[name].push_back(blocks - nearest);
            }
        }
    std::vector<Finding> all;
    for (const auto& [name, logarithms] : found) {
        Finding& finding = all.emplace_back(findings::meanOf(name, logarithms));
        for (double* const value : {&finding.value, &finding.low, &finding.high}) *value = std::exp(*value);
    }
    return all;
}

}  // namespace

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures how visible a grid's cells are as blocks in its picture, by filter, jitter and step.";
    info.source = "Senger2009";
    info.run = blocksByTreatment;
    return info;
}

}  // namespace dustbench::grid_fluid::lego
