// Tests the sort against std::stable_sort, with every way of counting and several sizes of tiles.
#include "methods/kit/gpu/sort/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "methods/contract/errors.h"

namespace dustbench::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

Device& sortingDevice() {
    static Device one;
    return one;
}

Buffer bufferOf(const Words& words, std::size_t room) {
    Buffer buffer(sortingDevice(), "test", std::max<std::size_t>(room, 1) * sizeof(std::uint32_t));
    buffer.write(std::span<const std::uint32_t>(words));
    return buffer;
}

Words wordsOf(const Buffer& buffer, std::size_t count) {
    Words words(count);
    buffer.read(std::span<std::uint32_t>(words));
    return words;
}

struct Pairs {
    Words keys, indices;
    bool operator==(const Pairs&) const = default;
};

Pairs numbered(Words keys) {
    Pairs pairs{std::move(keys), {}};
    pairs.indices.resize(pairs.keys.size());
    std::iota(pairs.indices.begin(), pairs.indices.end(), 0u);
    return pairs;
}

/// Indices that ascend, so that the stable order shows in the indices of equal keys.
Pairs plainlySorted(const Words& keys) {
    Pairs sorted = numbered(keys);
    std::stable_sort(sorted.indices.begin(), sorted.indices.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    std::ranges::transform(sorted.indices, sorted.keys.begin(), [&](std::uint32_t index) { return keys[index]; });
    return sorted;
}

Pairs sortedBy(RadixSort& sort, const Pairs& pairs, std::size_t room) {
    Buffer keys = bufferOf(pairs.keys, room), indices = bufferOf(pairs.indices, room);
    sort.sort(keys, indices, static_cast<std::uint32_t>(pairs.keys.size()));
    return {wordsOf(keys, pairs.keys.size()), wordsOf(indices, pairs.keys.size())};
}

Words randomKeys(std::size_t count, std::uint32_t maximum = ~0u) {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    std::uniform_int_distribution<std::uint32_t> uniform(0, maximum);
    Words keys(count);
    std::ranges::generate(keys, [&] { return uniform(random); });
    return keys;
}

/// Every way of counting that the device has.
std::vector<RadixSortSettings> ways(std::uint32_t keysPerThread = 16) {
    std::vector<RadixSortSettings> all;
    for (const EarlierTiles earlier : {EarlierTiles::scan, EarlierTiles::lookBack})
        for (const WarpRanks ranks : {WarpRanks::shared, WarpRanks::subgroups})
            if ((earlier == EarlierTiles::scan || RadixSort::canLookBack(sortingDevice())) &&
                (ranks == WarpRanks::shared || sortingDevice().subgroupThreads() == 32))
                all.push_back({earlier, ranks, keysPerThread});
    return all;
}

std::string nameOf(const RadixSortSettings& settings) {
    return std::string(earlierTilesChoices.wordOf(settings.earlierTiles)) + ", " +
           std::string(warpRanksChoices.wordOf(settings.warpRanks)) + ", " + std::to_string(settings.keysPerThread);
}

TEST(GpuRadixSort, EqualsTheStandardStableSortForEverySizeNextToATile) {
    for (const std::uint32_t keysPerThread : {1u, 7u, 16u, 24u})
        for (const RadixSortSettings& way : ways(keysPerThread)) {
            const std::size_t tile = 256 * keysPerThread, capacity = 6 * tile;
            RadixSort sort(sortingDevice(), static_cast<std::uint32_t>(capacity), way);
            for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{31},
                                            std::size_t{257}, tile - 1, tile, tile + 1, 5 * tile + 13, capacity}) {
                if (count > capacity) continue;
                const Words keys = randomKeys(count);
                ASSERT_EQ(sortedBy(sort, numbered(keys), capacity), plainlySorted(keys))
                    << nameOf(way) << ", " << count << " pairs";
            }
        }
}

TEST(GpuRadixSort, EqualsTheStandardStableSortForManyKeys) {
    std::vector<std::size_t> counts{1'000, 10'000, 100'000, 1'000'000};
    if (std::getenv("DUSTBENCH_FULL_SIZE")) counts.push_back(10'000'000);
    for (const std::size_t count : counts) {
        const Words keys = randomKeys(count);
        const Pairs expected = plainlySorted(keys);
        for (const RadixSortSettings& way : ways()) {
            RadixSort sort(sortingDevice(), static_cast<std::uint32_t>(count), way);
            ASSERT_TRUE(sortedBy(sort, numbered(keys), count) == expected) << nameOf(way) << ", " << count << " pairs";
        }
    }
}

TEST(GpuRadixSort, SortsShortKeysInTwoPasses) {
    constexpr std::uint32_t capacity = 50'000;
    for (const RadixSortSettings& way : ways()) {
        RadixSort sort(sortingDevice(), capacity, way);
        for (const std::uint32_t count : {0u, 1u, 4'097u, capacity}) {
            const Pairs pairs = numbered(randomKeys(count, 0xffff));
            Buffer keys = bufferOf(pairs.keys, capacity), indices = bufferOf(pairs.indices, capacity);
            sort.sort(keys, indices, count, 16);
            const Pairs sorted{wordsOf(keys, count), wordsOf(indices, count)};
            ASSERT_TRUE(sorted == plainlySorted(pairs.keys)) << nameOf(way) << ", " << count << " pairs";
            // Long keys again, with the same memory.
            const Words random = randomKeys(count);
            ASSERT_TRUE(sortedBy(sort, numbered(random), capacity) == plainlySorted(random)) << nameOf(way);
        }
        Buffer none = bufferOf({}, capacity);
        EXPECT_THROW(sort.sort(none, none, 1u, 24), std::invalid_argument);
    }
}

/// Equal keys keep their order: their indices ascend.
TEST(GpuRadixSort, IsStable) {
    constexpr std::size_t count = 50'000;
    for (const std::uint32_t maximum : {0u, 1u, 5u, 300u})
        for (const RadixSortSettings& way : ways()) {
            RadixSort sort(sortingDevice(), count, way);
            const Pairs sorted = sortedBy(sort, numbered(randomKeys(count, maximum)), count);
            for (std::size_t i = 1; i < count; ++i)
                ASSERT_TRUE(sorted.keys[i - 1] < sorted.keys[i] ||
                            (sorted.keys[i - 1] == sorted.keys[i] && sorted.indices[i - 1] < sorted.indices[i]))
                    << nameOf(way) << ", keys up to " << maximum << ", place " << i;
        }
}

TEST(GpuRadixSort, SortsWhatIsSortedReversedOrFullOfExtremes) {
    constexpr std::size_t count = 30'000;
    Words sorted = randomKeys(count), extremes(count);
    std::ranges::sort(sorted);
    const Words reversed(sorted.rbegin(), sorted.rend());
    for (std::size_t i = 0; i < count; ++i) extremes[i] = i % 3 == 0 ? ~0u : i % 3 == 1 ? 0u : 0x80000000u;
    const Words all(count, ~0u);
    for (const RadixSortSettings& way : ways()) {
        RadixSort sort(sortingDevice(), count, way);
        for (const Words& keys : {sorted, reversed, extremes, all})
            ASSERT_EQ(sortedBy(sort, numbered(keys), count), plainlySorted(keys)) << nameOf(way);
    }
}

/// Each digit is tested alone: other digits are equal.
TEST(GpuRadixSort, SortsByEveryDigit) {
    constexpr std::size_t count = 20'000;
    for (const RadixSortSettings& way : ways()) {
        RadixSort sort(sortingDevice(), count, way);
        for (int place = 0; place < 4; ++place) {
            Words keys = randomKeys(count, 255);
            for (std::uint32_t& key : keys) key = key << 8 * place | (place == 1 ? 0xab000012u : 0u);
            ASSERT_EQ(sortedBy(sort, numbered(keys), count), plainlySorted(keys)) << nameOf(way) << ", digit " << place;
        }
    }
}

TEST(GpuRadixSort, LeavesPairsBehindTheCountAlone) {
    constexpr std::size_t count = 5'000, capacity = 9'000;
    const Words keys = randomKeys(capacity);
    for (const RadixSortSettings& way : ways()) {
        RadixSort sort(sortingDevice(), capacity, way);
        Buffer keyBuffer = bufferOf(keys, capacity), indexBuffer = bufferOf(numbered(keys).indices, capacity);
        sort.sort(keyBuffer, indexBuffer, count);
        const Words after = wordsOf(keyBuffer, capacity), indices = wordsOf(indexBuffer, capacity);
        for (std::size_t i = count; i < capacity; ++i) {
            ASSERT_EQ(after[i], keys[i]) << nameOf(way);
            ASSERT_EQ(indices[i], i) << nameOf(way);
        }
    }
}

/// The same sort follows a number that changes in a buffer, and one from the CPU in between.
TEST(GpuRadixSort, TakesTheCountFromABuffer) {
    constexpr std::uint32_t capacity = 20'000;
    for (const RadixSortSettings& way : ways()) {
        RadixSort sort(sortingDevice(), capacity, way);
        for (const std::uint32_t count : {12'345u, 0u, 1u, 4'096u, 20'000u, 4'294'967'295u}) {
            const std::uint32_t used = std::min(count, capacity);
            const Words keys = randomKeys(capacity);
            const Words first(keys.begin(), keys.begin() + used);
            Buffer keyBuffer = bufferOf(keys, capacity), indexBuffer = bufferOf(numbered(keys).indices, capacity);
            const Buffer counts = bufferOf({7, 7, count}, 3);
            sort.sort(keyBuffer, indexBuffer, {counts, 2});
            ASSERT_EQ((Pairs{wordsOf(keyBuffer, used), wordsOf(indexBuffer, used)}), plainlySorted(first))
                << nameOf(way) << ", " << count;
            ASSERT_EQ(wordsOf(keyBuffer, capacity).back(),
                      used == capacity ? plainlySorted(keys).keys.back() : keys.back());
            ASSERT_EQ(sortedBy(sort, numbered(first), capacity), plainlySorted(first)) << nameOf(way);
        }
    }
}

/// Of 782 tiles, more than a group sums at once, and with groups that wait for each other.
TEST(GpuRadixSort, GivesTheSameInEveryRepetition) {
    constexpr std::size_t count = 200'000;
    const Words keys = randomKeys(count, 1'000);
    const Pairs expected = plainlySorted(keys);
    for (const RadixSortSettings& way : ways(1)) {
        RadixSort sort(sortingDevice(), count, way);
        for (int repetition = 0; repetition < 5; ++repetition)
            ASSERT_TRUE(sortedBy(sort, numbered(keys), count) == expected) << nameOf(way) << ", " << repetition;
    }
}

TEST(GpuRadixSort, ChoosesBothWaysForTheDevice) {
    const RadixSort sort(sortingDevice(), 100);
    const bool nvidia = sortingDevice().info().vendor.find("NVIDIA") != std::string::npos;
    EXPECT_EQ(sort.settings().earlierTiles, nvidia ? EarlierTiles::lookBack : EarlierTiles::scan);
    EXPECT_EQ(sort.settings().warpRanks,
              sortingDevice().subgroupThreads() == 32 ? WarpRanks::subgroups : WarpRanks::shared);
}

/// Runs the tests above in a process whose llvmpipe has one thread.
TEST(GpuRadixSort, LooksBackWhereGroupsNeverWait) {
    if (RadixSort::canLookBack(sortingDevice())) return;  // they have looked back
    EXPECT_THROW(RadixSort(sortingDevice(), 100, {.earlierTiles = EarlierTiles::lookBack}), InputError);
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    EXPECT_EQ(std::system(("LP_NUM_THREADS=1 '" + self + "' --gtest_brief=1 --gtest_filter='GpuRadixSort.*'").c_str()),
              0);
}

TEST(GpuRadixSort, RefusesMoreThanItHolds) {
    RadixSort sort(sortingDevice(), 100);
    Buffer keys = bufferOf(Words(200), 200), indices = bufferOf(Words(200), 200);
    EXPECT_THROW(sort.sort(keys, indices, 101), std::out_of_range);
    EXPECT_THROW(RadixSort(sortingDevice(), 100, {.keysPerThread = 25}), InputError);
    EXPECT_THROW(TilePlan(sortingDevice(), 65'535 * 16 + 1, 16), InputError);
}

std::vector<float> depthsOfBothSigns(std::size_t count) {
    std::vector<float> depths(count);
    const Words bits = randomKeys(count);
    for (std::size_t i = 0; i < count; ++i) {
        depths[i] = std::bit_cast<float>(bits[i]);
        if (depths[i] != depths[i]) depths[i] = i % 2 == 0 ? 0.0f : -0.0f;
    }
    const float infinity = std::numeric_limits<float>::infinity();
    depths[10] = infinity, depths[20] = -infinity, depths[30] = infinity;
    return depths;
}

TEST(DepthKeys, SortFloatsInBothDirectionsAndKeepTies) {
    constexpr std::size_t count = 10'000;
    std::vector<float> depths = depthsOfBothSigns(count);
    for (std::size_t i = 0; i < 500; ++i) depths[i + 5'000] = depths[i];
    const Buffer buffer(sortingDevice(), "depths", std::span<const float>(depths));
    DepthKeys depthKeys(sortingDevice(), count);
    RadixSort sort(sortingDevice(), count);
    for (const DepthOrder order : {DepthOrder::frontToBack, DepthOrder::backToFront}) {
        Buffer keys = bufferOf({}, count), indices = bufferOf({}, count);
        depthKeys.write(buffer, std::uint32_t{count}, order, keys, indices);
        sort.sort(keys, indices, std::uint32_t{count});
        Words expected = numbered(Words(count)).indices;
        std::ranges::stable_sort(expected, [&](std::uint32_t a, std::uint32_t b) {
            return order == DepthOrder::frontToBack ? depths[a] < depths[b] : depths[a] > depths[b];
        });
        EXPECT_EQ(wordsOf(indices, count), expected);
    }
}

TEST(DepthKeys, AreThoseOfTheCpu) {
    constexpr std::size_t count = 3'000;
    const std::vector<float> depths = depthsOfBothSigns(count);
    const Buffer buffer(sortingDevice(), "depths", std::span<const float>(depths));
    Buffer keys = bufferOf({}, count), indices = bufferOf({}, count);
    DepthKeys(sortingDevice(), count).write(buffer, std::uint32_t{count}, DepthOrder::frontToBack, keys, indices);
    const Words found = wordsOf(keys, count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(found[i], sortableKey(depths[i])) << depths[i];
}

}  // namespace
}  // namespace dustbench::gpu
