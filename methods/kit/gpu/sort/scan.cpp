#include "methods/kit/gpu/sort/scan.h"

#include <algorithm>
#include <map>
#include <string>

#include "gpu_sort_shaders.h"

namespace dustbench::gpu {
namespace {

using namespace gpu_sort_shaders;
using Definitions = std::map<std::string, std::string>;

constexpr std::uint32_t scannedTile = 2048;

Buffer sumsOfTiles(Device& device, const TilePlan& plan) {
    return {device, "scan: sums of tiles", std::max<std::size_t>(plan.maximumTiles(), 1) * sizeof(std::uint32_t)};
}

/// `loaded`: an element as a summand.
Program tileProgram(Device& device, const ShaderFile& file, const std::string& loaded, Definitions definitions) {
    definitions["TILE_ELEMENTS"] = std::to_string(scannedTile) + "u";
    definitions["LOADED(element)"] = loaded;
    return {device, file.name, {group_glsl, file}, definitions};
}
const Definitions sumOfNumbers{{"NUMBER", "uint"}, {"COMBINE(a, b)", "(a + b)"}, {"IDENTITY", "0u"}};

/// Sums of the tiles before each tile; records the total.
void sumEarlierTiles(const TilePlan& plan, Program& sumTiles, const Buffer& before, Program& sumRow, Buffer& total) {
    before.bindStorage(6);
    sumTiles.set("overTiles", 0);
    plan.runPerTile(sumTiles);
    total.bindStorage(5);
    sumRow.set("firstTotal", 0);
    sumRow.dispatch(1, 1, 1);
}

}  // namespace

InclusiveScan::InclusiveScan(Device& device, std::uint32_t capacity)
    : plan_(device, capacity, scannedTile),
      before_(sumsOfTiles(device, plan_)),
      total_(device, "scan: total", sizeof(std::uint32_t)),
      sumTiles_(tileProgram(device, reduce_comp, "element", sumOfNumbers)),
      sumRow_(device, row_sums_comp.name, {group_glsl, row_sums_comp}),
      scan_(tileProgram(device, scan_comp, "element", {})) {}

void InclusiveScan::scan(const Buffer& elements, Buffer& sums, const ElementCount& count) {
    plan_.set(count);
    plan_.bind();
    elements.bindStorage(1);
    sumEarlierTiles(plan_, sumTiles_, before_, sumRow_, total_);
    sums.bindStorage(3);
    plan_.runPerTile(scan_);
}

Compaction::Compaction(Device& device, std::uint32_t capacity)
    : plan_(device, capacity, scannedTile),
      before_(sumsOfTiles(device, plan_)),
      sumTiles_(tileProgram(device, reduce_comp, "min(element, 1u)", sumOfNumbers)),
      sumRow_(device, row_sums_comp.name, {group_glsl, row_sums_comp}),
      scan_(tileProgram(device, scan_comp, "min(element, 1u)", {{"COMPACT", ""}})) {}

void Compaction::compact(const Buffer& values, const Buffer& flags, const ElementCount& count, Buffer& kept,
                         Buffer& keptCount) {
    plan_.set(count);
    plan_.bind();
    flags.bindStorage(1);
    sumEarlierTiles(plan_, sumTiles_, before_, sumRow_, keptCount);
    values.bindStorage(2);
    kept.bindStorage(3);
    plan_.runPerTile(scan_);
}

}  // namespace dustbench::gpu
