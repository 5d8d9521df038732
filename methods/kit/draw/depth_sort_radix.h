// Least-significant-digit radix sort of depths, stable, far to near; the depths' range sets number and width of digits.
//
// A cloud's depths share their leading bits. After subtracting the minimum key about 27 bits remain: three digits of 9
// bits, whose 512 buckets stay in the first-level cache, unlike the 2048 buckets of 11 bits. Threads: works over the
// current oneTBB arena in `blocks`; the result does not depend on the blocks, because the sort is stable.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>

#include "methods/kit/draw/depth_sort_key.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::draw {

inline constexpr int radixMaximumBits = 11;
inline constexpr std::size_t radixMaximumBuckets = std::size_t{1} << radixMaximumBits;
inline constexpr std::size_t radixMaximumDigits = 3;
inline constexpr std::size_t radixMaximumBlocks = 16;
/// Counts of one digit for every block, or of every digit for a single block.
inline constexpr std::size_t radixCounts = std::max(radixMaximumBlocks, radixMaximumDigits) * radixMaximumBuckets;

class RadixSort {
 public:
    /// `front`, `back` and `order` have one element per point; `counts` has radixCounts elements.
    RadixSort(std::span<std::uint64_t> front, std::span<std::uint64_t> back, std::span<std::uint32_t> order,
              std::span<std::uint32_t> counts, std::size_t blocks)
        : from_(front.data()),
          to_(back.data()),
          order_(order.data()),
          counts_(counts.data()),
          count_(order.size()),
          blocks_(std::clamp<std::size_t>(blocks, 1, radixMaximumBlocks)) {}

    /// Writes the indices by decreasing `depth(index)` into `order`.
    template <typename Depth>
    void sort(const Depth& depth) {
        if (count_ == 0) return;
        findKeys(depth);
        chooseDigits();
        if (digits_ == 0) {
            for (std::size_t i = 0; i < count_; ++i) order_[i] = static_cast<std::uint32_t>(i);
            return;
        }
        // The keys are stored in `order` until the first digit has been scattered.
        const auto keys = [order = order_](std::size_t i) { return keyedIndex(order[i], i); };
        const auto toOrder = [order = order_](std::size_t place, std::uint64_t element) {
            order[place] = indexOf(element);
        };
        for (int digit = 0; digit < digits_; ++digit) {
            const auto elements = [from = from_](std::size_t i) { return from[i]; };
            const auto toElements = [to = to_](std::size_t place, std::uint64_t element) { to[place] = element; };
            if (digit == 0)
                deal(digit, keys, toElements);
            else if (digit + 1 < digits_)
                deal(digit, elements, toElements);
            else
                deal(digit, elements, toOrder);
            std::swap(from_, to_);
        }
    }

 private:
    [[nodiscard]] std::size_t begin(std::size_t block) const { return count_ * block / blocks_; }
    /// (key, i) ↦ the i-th digit of the key, counted from `firstDigit`. Captures by value: the loops keep it in
    /// registers.
    [[nodiscard]] auto digitsFrom(int firstDigit) const {
        return [minimum = minimum_, mask = static_cast<std::uint32_t>(buckets_ - 1), bits = bits_,
                first = bits_ * firstDigit](std::uint32_t key, int digit) {
            return (key - minimum) >> (first + bits * digit) & mask;
        };
    }

    template <typename Work>
    void forBlocks(const Work& work) const {
        parallel::forEachBlock(blocks_, 1, [&](std::size_t block, std::size_t) { work(block); });
    }

    template <typename Depth>
    void findKeys(const Depth& depth) {
        std::array<std::uint32_t, radixMaximumBlocks> minimum{}, maximum{};
        forBlocks([&](std::size_t block) {
            std::uint32_t lowest = ~0u, highest = 0;
            std::uint32_t* const keys = order_;
            const std::size_t end = begin(block + 1);
            for (std::size_t i = begin(block); i < end; ++i) {
                const std::uint32_t key = farFirstKey(depth(i));
                keys[i] = key;
                lowest = std::min(lowest, key);
                highest = std::max(highest, key);
            }
            minimum[block] = lowest;
            maximum[block] = highest;
        });
        minimum_ = *std::min_element(minimum.begin(), minimum.begin() + static_cast<std::ptrdiff_t>(blocks_));
        maximum_ = *std::max_element(maximum.begin(), maximum.begin() + static_cast<std::ptrdiff_t>(blocks_));
    }

    void chooseDigits() {
        const int span = std::bit_width(maximum_ - minimum_);
        // At least two digits, because keys and result share memory.
        digits_ = span == 0 ? 0 : std::max(2, (span + radixMaximumBits - 1) / radixMaximumBits);
        bits_ = digits_ == 0 ? 0 : (span + digits_ - 1) / digits_;
        buckets_ = std::size_t{1} << bits_;
    }

    /// A single block keeps the counts of all digits; several blocks keep those of the current digit.
    [[nodiscard]] std::uint32_t* countsOf(int digit, std::size_t block) const {
        return counts_ + (blocks_ == 1 ? static_cast<std::size_t>(digit) : block) * buckets_;
    }

    template <int digits, typename Source>
    void count(int firstDigit, std::size_t block, const Source& source) const {
        std::array<std::uint32_t*, digits> counts;
        for (int digit = 0; digit < digits; ++digit) {
            counts[digit] = countsOf(firstDigit + digit, block);
            std::fill_n(counts[digit], buckets_, 0u);
        }
        const auto digitOf = digitsFrom(firstDigit);
        const std::size_t end = begin(block + 1);
        for (std::size_t i = begin(block); i < end; ++i) {
            const std::uint32_t key = keyOf(source(i));
            for (int digit = 0; digit < digits; ++digit) ++counts[digit][digitOf(key, digit)];
        }
    }

    /// Scatters by one digit: elements in order, each to the next position in its bucket.
    template <typename Source, typename Target>
    void deal(int digit, const Source& source, const Target& target) {
        if (blocks_ > 1)
            forBlocks([&](std::size_t block) { count<1>(digit, block, source); });
        else if (digit == 0)
            digits_ == 2 ? count<2>(0, 0, source) : count<3>(0, 0, source);
        // Counts become offsets: bucket by bucket, and within a bucket block by block.
        std::uint32_t place = 0;
        for (std::size_t bucket = 0; bucket < buckets_; ++bucket)
            for (std::size_t block = 0; block < blocks_; ++block)
                place += std::exchange(countsOf(digit, block)[bucket], place);
        forBlocks([&](std::size_t block) {
            std::uint32_t* const places = countsOf(digit, block);
            const auto digitOf = digitsFrom(digit);
            const std::size_t end = begin(block + 1);
            for (std::size_t i = begin(block); i < end; ++i) {
                const std::uint64_t element = source(i);
                target(places[digitOf(keyOf(element), 0)]++, element);
            }
        });
    }

    std::uint64_t *from_, *to_;
    std::uint32_t* order_;
    std::uint32_t* counts_;
    std::size_t count_, blocks_;
    std::uint32_t minimum_ = 0, maximum_ = 0;
    int digits_ = 0, bits_ = 0;
    std::size_t buckets_ = 1;
};

}  // namespace dustbench::draw
