#include "methods/kit/gpu/sort/radix_sort.h"

#include <array>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gpu_sort_shaders.h"
#include "methods/contract/errors.h"

namespace dustbench::gpu {
namespace {

using namespace gpu_sort_shaders;

constexpr std::uint32_t depthTile = 2048;

constexpr int places = 4, bitsOfDigit = 8;
constexpr std::uint32_t values = 256, groupThreads = 256, maximumKeysPerThread = 24;
constexpr std::size_t wordBytes = sizeof(std::uint32_t);

RadixSortSettings settled(const Device& device, RadixSortSettings settings) {
    if (settings.keysPerThread < 1 || settings.keysPerThread > maximumKeysPerThread)
        throw InputError("keys per thread: got " + std::to_string(settings.keysPerThread) + ", expected 1 to " +
                         std::to_string(maximumKeysPerThread));
    if (settings.earlierTiles == EarlierTiles::automatic)
        settings.earlierTiles =
            device.info().vendor.find("NVIDIA") != std::string::npos ? EarlierTiles::lookBack : EarlierTiles::scan;
    if (settings.warpRanks == WarpRanks::automatic)
        settings.warpRanks = device.subgroupThreads() == 32 ? WarpRanks::subgroups : WarpRanks::shared;
    return settings;
}

bool looksBack(const RadixSortSettings& settings) {
    return settings.earlierTiles == EarlierTiles::lookBack;
}

Program digitProgram(Device& device, const RadixSortSettings& settings, const ShaderFile& file, bool isScatter) {
    std::map<std::string, std::string> definitions{{"KEYS_PER_THREAD", std::to_string(settings.keysPerThread) + "u"}};
    if (isScatter && looksBack(settings)) definitions["LOOK_BACK"] = "";
    if (isScatter && settings.warpRanks == WarpRanks::subgroups) definitions["SUBGROUPS"] = "";
    return {device, file.name, {group_glsl, digits_glsl, file}, definitions};
}

}  // namespace

DepthKeys::DepthKeys(Device& device, std::uint32_t capacity)
    : plan_(device, capacity, depthTile),
      program_(device, "depth keys",
               {gpu_sort_shaders::group_glsl, gpu_sort_shaders::sortable_glsl, gpu_sort_shaders::depth_keys_comp},
               {{"TILE_ELEMENTS", std::to_string(depthTile) + "u"}}) {}

void DepthKeys::write(const Buffer& depths, const ElementCount& count, DepthOrder order, Buffer& keys,
                      Buffer& indices) {
    plan_.set(count);
    plan_.bind();
    depths.bindStorage(1);
    keys.bindStorage(2);
    indices.bindStorage(3);
    program_.set("backToFront", order == DepthOrder::backToFront ? 1 : 0);
    plan_.runPerTile(program_);
}

RadixSort::RadixSort(Device& device, std::uint32_t capacity, RadixSortSettings settings)
    : settings_(settled(device, settings)),
      plan_(device, capacity, groupThreads * settings_.keysPerThread),
      spareKeys_(device, "sort: second keys", capacity * wordBytes),
      spareIndices_(device, "sort: second indices", capacity * wordBytes),
      totals_(device, "sort: counts", (places * values + places) * wordBytes),
      states_(device, "sort: counts of tiles",
              std::size_t{plan_.maximumTiles()} * values * wordBytes * (looksBack(settings_) ? places : 1)),
      scatter_(digitProgram(device, settings_, scatter_comp, true)) {
    if (looksBack(settings_)) {
        count_ = digitProgram(device, settings_, all_digits_comp, false);
        // Last, so that a test can check the programs on every device.
        if (!canLookBack(device))
            throw InputError("earlier tiles: got look_back on " + device.info().renderer +
                             ", expected scan, because its groups may not wait for each other");
    } else {
        count_ = digitProgram(device, settings_, tile_digits_comp, false);
        sumRows_ = Program(device, row_sums_comp.name, {group_glsl, row_sums_comp});
    }
}

bool RadixSort::canLookBack(const Device& device) {
    const char* threads = std::getenv("LP_NUM_THREADS");
    return !device.isSoftware() || (threads && (std::string_view(threads) == "1" || std::string_view(threads) == "0"));
}

void RadixSort::sort(Buffer& keys, Buffer& indices, const ElementCount& count, int keyBits) {
    if (keyBits != 16 && keyBits != 32)
        throw std::invalid_argument("bits of keys: got " + std::to_string(keyBits) + ", expected 16 or 32");
    if (plan_.capacity() == 0) return;
    const int passes = keyBits / bitsOfDigit;  // even, so that the last one writes to the given buffers
    plan_.set(count);
    plan_.bind();
    if (looksBack(settings_)) countAllDigits(keys, passes);
    const std::array<const Buffer*, 2> keysOf{&keys, &spareKeys_}, indicesOf{&indices, &spareIndices_};
    for (int place = 0; place < passes; ++place) {
        const auto from = static_cast<std::size_t>(place % 2), to = 1 - from;
        if (!looksBack(settings_)) countTiles(place, *keysOf[from]);
        keysOf[from]->bindStorage(1);
        indicesOf[from]->bindStorage(2);
        keysOf[to]->bindStorage(3);
        indicesOf[to]->bindStorage(4);
        totals_.bindStorage(5);
        states_.bindStorage(6);
        scatter_.set("place", place);
        plan_.runPerTile(scatter_);
    }
}

void RadixSort::countAllDigits(const Buffer& keys, int passes) {
    totals_.clear();
    keys.bindStorage(1);
    totals_.bindStorage(5);
    states_.bindStorage(6);
    count_.set("passes", passes);
    plan_.runPerShare(count_);
}

void RadixSort::countTiles(int place, const Buffer& keys) {
    keys.bindStorage(1);
    totals_.bindStorage(5);
    states_.bindStorage(6);
    count_.set("place", place);
    plan_.runPerTile(count_);
    sumRows_.set("firstTotal", place * static_cast<int>(values));
    sumRows_.dispatch(static_cast<int>(values), 1, 1);
}

std::size_t RadixSort::bytes() const {
    return plan_.bytes() + spareKeys_.bytes() + spareIndices_.bytes() + totals_.bytes() + states_.bytes();
}

}  // namespace dustbench::gpu
