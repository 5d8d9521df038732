#include "methods/relief/particles_gl/texture_mover.h"

#include <algorithm>
#include <array>
#include <string>

#include "relief_particles_gl_shaders.h"

namespace dustbench::relief {
namespace {

constexpr int stateColumns = 1024;
constexpr std::size_t groupSize = 64;

/// Layout of the shader's block.
struct Plate {
    glm::dvec4 halfSize, scale, offset;
};

Plate plateOf(const scene::Panel& panel) {
    const TexelFrame texels(panel);
    const glm::dvec3 zero = texels.toTexels(glm::dvec3(0)), one = texels.toTexels(glm::dvec3(1));
    return {glm::dvec4(panel.sizeMetres / 2.0, 0, 0), glm::dvec4(one - zero, 0), glm::dvec4(zero, 0)};
}

int rowsFor(std::size_t particles) {
    int rows = 1;
    while (static_cast<std::size_t>(rows) * stateColumns < particles) rows *= 2;
    return rows;
}

template <typename T>
void writeGrowing(gpu::Device& device, gpu::Buffer& buffer, const char* label, std::span<const T> values) {
    if (values.size_bytes() > buffer.bytes()) buffer = gpu::Buffer(device, label, 2 * values.size_bytes());
    buffer.write(values);
}

}  // namespace

TextureMover::TextureMover(gpu::Device& device, const scene::Panel& panel, const DepthMap& surface)
    : device_(device),
      program_(device, "relief particles", {relief_particles_gl_shaders::move_particles_comp},
               {{"STATE_COLUMNS", std::to_string(stateColumns)}}),
      plate_(device, "relief plate", std::span<const Plate>(std::array{plateOf(panel)})),
      depths_(device, "relief depths for particles", surface.depths()),
      newborns_(device, "relief newborns", sizeof(glm::vec4)) {
    program_.set("texels", glm::vec2(surface.columns(), surface.rows()));
    makeRoom(1);
    std::swap(now_, next_);
    makeRoom(1);
}

void TextureMover::upload(const DepthMap& surface, const TexelRectangle& changed) {
    if (changed.empty()) return;
    const std::size_t first = surface.texel(0, changed.firstRow), end = surface.texel(0, changed.endRow);
    depths_.writeFrom(first, surface.depths().subspan(first, end - first));
}

void TextureMover::makeRoom(std::size_t particles) {
    const int rows = rowsFor(particles);
    if (next_.places.height() >= rows) return;
    for (gpu::Texture* texture : {&next_.places, &next_.velocities})
        *texture = gpu::Texture::make2D(device_, "relief particle state", gpu::Format::rgba32F, stateColumns, rows);
}

/// The source of each particle: a texel of the old state, or −1 − k for the k-th newborn one.
void TextureMover::writeSources(const MovingColumns& columns) {
    std::vector<glm::vec4> newborns;
    for (std::size_t i = living_.size(); i < columns.places.size(); ++i) {
        newborns.push_back(columns.places[i]);
        newborns.push_back(columns.velocities[i]);
    }
    for (std::size_t k = 0; k < newborns.size() / 2; ++k) living_.push_back(-1 - static_cast<std::int32_t>(k));
    writeGrowing(device_, sources_, "relief sources", std::span<const std::int32_t>(living_));
    if (!newborns.empty()) writeGrowing(device_, newborns_, "relief newborns", std::span<const glm::vec4>(newborns));
}

void TextureMover::run(std::size_t particles, const StepSettings& settings) {
    program_.set("particles", static_cast<int>(particles));
    program_.set("paperLaw", settings.law == MotionLaw::paper ? 1 : 0);
    program_.set("gravity", settings.gravity);
    program_.set("stepSeconds", settings.stepSeconds);
    program_.set("maximumAge", settings.maximumAgeSteps);
    now_.places.bind(0);
    now_.velocities.bind(1);
    next_.places.bindImage(0, false, true);
    next_.velocities.bindImage(1, false, true);
    plate_.bindStorage(1);
    depths_.bindStorage(2);
    sources_.bindStorage(3);
    newborns_.bindStorage(4);
    program_.dispatch(static_cast<int>((particles + groupSize - 1) / groupSize), 1, 1);
}

void TextureMover::readBack(const MovingColumns& columns) {
    const std::vector<float> places = now_.places.readFloats(), velocities = now_.velocities.readFloats();
    living_.clear();
    for (std::size_t i = 0; i < columns.places.size(); ++i) {
        const float* place = &places[4 * i];
        const float* velocity = &velocities[4 * i];
        columns.places[i] = {place[0], place[1], place[2], place[3]};
        columns.velocities[i] = {velocity[0], velocity[1], velocity[2], 0};
        columns.fates[i] = static_cast<Fate>(velocity[3]);
        if (columns.fates[i] == Fate::lives) living_.push_back(static_cast<std::int32_t>(i));
    }
}

TextureMover::StateCopy TextureMover::copyState() const {
    StateCopy copy{stateColumns, rowsFor(std::max<std::size_t>(used_, 1)), {}, {}};
    const auto texels = static_cast<std::size_t>(copy.columns) * static_cast<std::size_t>(copy.rows);
    const auto take = [&](const gpu::Texture& texture, std::vector<glm::vec4>& into) {
        const std::vector<float> values = texture.readFloats();
        into.assign(texels, glm::vec4(0));
        for (std::size_t n = 0; n < used_; ++n)
            into[n] = {values[4 * n], values[4 * n + 1], values[4 * n + 2], values[4 * n + 3]};
    };
    take(now_.places, copy.places);
    take(now_.velocities, copy.velocities);
    return copy;
}

void TextureMover::move(const MovingColumns& columns, const DepthMap&, const StepSettings& settings) {
    used_ = columns.places.size();
    if (columns.places.empty()) return;
    makeRoom(columns.places.size());
    writeSources(columns);
    run(columns.places.size(), settings);
    std::swap(now_, next_);
    readBack(columns);
}

std::size_t TextureMover::gpuBytes() const {
    std::size_t bytes = plate_.bytes() + depths_.bytes() + sources_.bytes() + newborns_.bytes();
    for (const State* state : {&now_, &next_}) bytes += state->places.bytes() + state->velocities.bytes();
    return bytes;
}

}  // namespace dustbench::relief
