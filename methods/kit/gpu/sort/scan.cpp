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

constexpr std::uint32_t reducedTile = 2048;

std::map<std::string, std::string> definitionsOf(Reduce operation, Number number) {
    const bool isFloat = number == Number::float32;
    std::map<std::string, std::string> definitions{{"TILE_ELEMENTS", std::to_string(reducedTile) + "u"},
                                                   {"NUMBER", isFloat ? "float" : "uint"},
                                                   {"LOADED(element)", "element"}};
    switch (operation) {
        case Reduce::sum:
            definitions["COMBINE(a, b)"] = "(a + b)";
            definitions["IDENTITY"] = isFloat ? "0.0" : "0u";
            break;
        case Reduce::minimum:
            definitions["COMBINE(a, b)"] = "min(a, b)";
            definitions["IDENTITY"] = isFloat ? "uintBitsToFloat(0x7f800000u)" : "0xffffffffu";
            break;
        case Reduce::maximum:
            definitions["COMBINE(a, b)"] = "max(a, b)";
            definitions["IDENTITY"] = isFloat ? "uintBitsToFloat(0xff800000u)" : "0u";
            break;
    }
    return definitions;
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

Reduction::Reduction(Device& device, std::uint32_t capacity, Reduce operation, Number number)
    : plan_(device, capacity, reducedTile),
      ofTiles_(device, "reduction: values of tiles",
               std::max<std::size_t>(plan_.maximumTiles(), 1) * sizeof(std::uint32_t)),
      program_(device, "reduction", {gpu_sort_shaders::group_glsl, gpu_sort_shaders::reduce_comp},
               definitionsOf(operation, number)) {}

void Reduction::reduce(const Buffer& elements, const ElementCount& count, Buffer& result) {
    plan_.set(count);
    plan_.bind();
    elements.bindStorage(1);
    ofTiles_.bindStorage(6);
    program_.set("overTiles", 0);
    plan_.runPerTile(program_);
    ofTiles_.bindStorage(1);
    result.bindStorage(6);
    program_.set("overTiles", 1);
    program_.dispatch(1, 1, 1);
}

}  // namespace dustbench::gpu
