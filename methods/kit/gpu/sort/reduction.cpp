#include "methods/kit/gpu/sort/reduction.h"

#include <algorithm>
#include <map>
#include <string>

#include "gpu_sort_shaders.h"

namespace dustbench::gpu {
namespace {

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
