#include "methods/kit/draw/tile_lists.h"

#include <algorithm>
#include <span>

#include "draw_shaders.h"
#include "methods/contract/errors.h"

namespace dustbench::draw {
namespace {

constexpr std::size_t wordOfPairs = sizeof(std::uint32_t);
constexpr std::uint32_t tilesOfShape = 4, groupOfShapes = 256, minimumShapes = 4096, maximumGroups = 65535;
constexpr int maximumTileLevels = 12;

gpu::Program pairProgram(gpu::Device& device, const char* name, const std::vector<gpu::ShaderFile>& pieces,
                         std::map<std::string, std::string> definitions, bool emit) {
    if (emit) definitions["EMIT"] = "";
    std::vector<gpu::ShaderFile> files{draw_shaders::tile_pyramid_glsl};
    files.insert(files.end(), pieces.begin(), pieces.end());
    files.push_back(draw_shaders::tile_pairs_comp);
    return {device, std::string(name) + ": tiles", std::span<const gpu::ShaderFile>(files), definitions};
}

}  // namespace

TileLists::Pairs::Pairs(gpu::Device& device, std::uint32_t number)
    : capacity(number),
      ends(device, "lists of tiles", number * wordOfPairs),
      tiles(device, "lists of tiles", number * tilesOfShape * wordOfPairs),
      shapes(device, "lists of tiles", number * tilesOfShape * wordOfPairs),
      scan(device, number),
      sort(device, number * tilesOfShape) {}

TileLists::TileLists(gpu::Device& device, const char* name, const std::vector<gpu::ShaderFile>& pieces,
                     const std::map<std::string, std::string>& definitions)
    : device_(device),
      name_(name),
      count_(pairProgram(device, name, pieces, definitions, false)),
      emit_(pairProgram(device, name, pieces, definitions, true)),
      findRanges_(device, "ranges of tiles", {draw_shaders::tile_ranges_comp}),
      number_(device, "lists of tiles", wordOfPairs),
      pairCount_(device, "lists of tiles", 4 * wordOfPairs) {
    number_.clear();
}

void TileLists::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    int levels = 0;
    std::size_t tiles = 0;
    for (int columns = tilesAlong(width), rows = tilesAlong(height);;
         columns = (columns + 1) / 2, rows = (rows + 1) / 2) {
        ++levels;
        tiles += static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
        if (columns <= 2 && rows <= 2) break;
    }
    if (levels > maximumTileLevels)
        throw InputError(name_ + ": got a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                         ", expected at most " + std::to_string((2 * tilePixels) << (maximumTileLevels - 1)) +
                         " pixels along an edge");
    ranges_ = gpu::Buffer(device_, "lists of tiles", tiles * 2 * wordOfPairs);
    width_ = width, height_ = height, levels_ = levels, tiles_ = tiles;
}

void TileLists::reserve(std::uint32_t shapes) {
    if (pairs_ && shapes <= pairs_->capacity) return;
    const std::size_t maximum = std::min<std::size_t>(device_.maximumStorageBytes() / (tilesOfShape * wordOfPairs),
                                                      maximumGroups * groupOfShapes);
    if (shapes > maximum)
        throw InputError(name_ + ": got up to " + std::to_string(shapes) +
                         " shapes in tiles, allowed on this device: " + std::to_string(maximum));
    const std::size_t doubled = pairs_ ? 2 * std::size_t{pairs_->capacity} : minimumShapes;
    pairs_.reset();
    pairs_ = std::make_unique<Pairs>(device_, std::max(shapes, static_cast<std::uint32_t>(std::min(doubled, maximum))));
}

void TileLists::build(const Shapes& shapes, int width, int height, const std::function<void(gpu::Program&)>& prepare) {
    resize(width, height);
    reserve(shapes.number);
    if (!shapes.numberOnGpu && shapes.number != writtenNumber_) {
        number_.write(std::span<const std::uint32_t>(&shapes.number, 1));
        writtenNumber_ = shapes.number;
    }
    const gpu::Buffer& number = shapes.numberOnGpu ? *shapes.numberOnGpu : number_;
    const int groups = static_cast<int>((shapes.number + groupOfShapes - 1) / groupOfShapes);
    const auto run = [&](gpu::Program& program) {
        describe(program);
        prepare(program);
        pairs_->ends.bindStorage(1);
        pairs_->tiles.bindStorage(2);
        pairs_->shapes.bindStorage(3);
        pairCount_.bindStorage(4);
        number.bindStorage(5);
        if (groups > 0) program.dispatch(groups, 1, 1);
    };
    pairCount_.clear();
    ranges_.clear();
    run(count_);
    pairs_->scan.scan(pairs_->ends, pairs_->ends, number);
    run(emit_);
    const gpu::ElementCount count(pairCount_);
    pairs_->sort.sort(pairs_->tiles, pairs_->shapes, count, tiles_ <= 0x10000 ? 16 : 32);
    pairCount_.bindStorage(0);
    pairs_->tiles.bindStorage(1);
    ranges_.bindStorage(2);
    findRanges_.dispatchIndirect(pairCount_, wordOfPairs);
}

void TileLists::describe(gpu::Program& program) const {
    program.set("picture", glm::ivec3(width_, height_, levels_));
}

void TileLists::bind() const {
    ranges_.bindStorage(1);
    pairs_->shapes.bindStorage(2);
}

std::size_t TileLists::bytes() const {
    std::size_t bytes = number_.bytes() + pairCount_.bytes() + ranges_.bytes();
    if (pairs_)
        bytes += pairs_->ends.bytes() + pairs_->tiles.bytes() + pairs_->shapes.bytes() + pairs_->scan.bytes() +
                 pairs_->sort.bytes();
    return bytes;
}

}  // namespace dustbench::draw
