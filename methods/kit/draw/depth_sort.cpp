#include "methods/kit/draw/depth_sort.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::draw {
namespace {

// --- Depths as integers whose ascending order is far to near, packed with the point's index into one key.

/// The key of a depth: the larger the depth, the smaller the key. −0 and 0 have the same key.
std::uint32_t farFirstKey(float depth) {
    // Floats order as their bits do, negative ones in reverse: flip the sign bit if positive, all bits if negative.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(depth + 0.0f);
    const std::uint32_t flip = static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> 31) | 0x80000000u;
    return ~(bits ^ flip);
}

/// Ascending order is far to near; ties by index.
std::uint64_t keyedIndex(std::uint32_t key, std::size_t index) {
    return static_cast<std::uint64_t>(key) << 32 | static_cast<std::uint32_t>(index);
}

std::uint32_t keyOf(std::uint64_t keyed) {
    return static_cast<std::uint32_t>(keyed >> 32);
}

std::uint32_t indexOf(std::uint64_t keyed) {
    return static_cast<std::uint32_t>(keyed);
}

// --- Quicksort of keyed indices, as the paper's renderer uses it.
// Source: Hoare1962; median of three and a final insertion sort: Sedgewick1978.

constexpr std::ptrdiff_t insertionLength = 24;

void insertionSort(std::uint64_t* first, std::uint64_t* last) {
    if (first == last) return;  // of no elements, `first` may be null, to which nothing may be added
    for (std::uint64_t* next = first + 1; next < last; ++next) {
        const std::uint64_t value = *next;
        std::uint64_t* hole = next;
        for (; hole > first && value < hole[-1]; --hole) *hole = hole[-1];
        *hole = value;
    }
}

/// Orders the first, middle and last element, which leaves sentinels at both ends. Returns the median.
std::uint64_t medianOfThree(std::uint64_t& a, std::uint64_t& b, std::uint64_t& c) {
    if (b < a) std::swap(a, b);
    if (c < b) std::swap(b, c);
    if (b < a) std::swap(a, b);
    return b;
}

/// Hoare's partition: elements before the returned position are ≤ the pivot, elements from it on are ≥ the pivot.
std::uint64_t* partition(std::uint64_t* first, std::uint64_t* last) {
    const std::uint64_t pivot = medianOfThree(*first, first[(last - first) / 2], last[-1]);
    std::uint64_t* left = first;
    std::uint64_t* right = last - 1;
    for (;;) {
        do ++left;
        while (*left < pivot);
        do --right;
        while (pivot < *right);
        if (left >= right) return left;
        std::swap(*left, *right);
    }
}

void sortRange(std::uint64_t* first, std::uint64_t* last, int splitsLeft) {
    while (last - first > insertionLength) {
        if (splitsLeft-- == 0) {  // too many splits, as for adversarial input: fall back to heap sort
            std::make_heap(first, last);
            std::sort_heap(first, last);
            return;
        }
        std::uint64_t* const middle = partition(first, last);
        // The loop handles the longer side, so that the stack depth stays logarithmic.
        if (middle - first < last - middle) {
            sortRange(first, middle, splitsLeft);
            first = middle;
        } else {
            sortRange(middle, last, splitsLeft);
            last = middle;
        }
    }
    insertionSort(first, last);
}

/// Ascending, in place. Deterministic; O(n log n) in the worst case too.
void quicksort(std::span<std::uint64_t> values) {
    const int splits = 2 * static_cast<int>(std::bit_width(values.size()));
    sortRange(values.data(), values.data() + values.size(), splits);
}

// --- Least-significant-digit radix sort of depths, stable, far to near; the depths' range sets number and width of
// digits.
//
// A cloud's depths share their leading bits. After subtracting the minimum key about 27 bits remain: three digits of 9
// bits, whose 512 buckets stay in the first-level cache, unlike the 2048 buckets of 11 bits. Works over the current
// oneTBB arena in `blocks`; the result does not depend on the blocks, because the sort is stable.

constexpr int radixMaximumBits = 11;
constexpr std::size_t radixMaximumBuckets = std::size_t{1} << radixMaximumBits;
constexpr std::size_t radixMaximumDigits = 3;
constexpr std::size_t radixMaximumBlocks = 16;
/// Counts of one digit for every block, or of every digit for a single block.
constexpr std::size_t radixCounts = std::max(radixMaximumBlocks, radixMaximumDigits) * radixMaximumBuckets;

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

// --- DepthSort

/// With fewer points per block, a second thread costs more than it saves.
constexpr std::size_t pointsPerBlock = 50'000;

std::size_t blocksFor(std::size_t count) {
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    return std::clamp<std::size_t>(std::min(threads, count / pointsPerBlock), 1, radixMaximumBlocks);
}

/// |p − e|²: has the same order as the distance.
struct SquaredDistance {
    const float *x, *y, *z;
    float ex, ey, ez;

    float operator()(std::size_t i) const {
        const float dx = x[i] - ex, dy = y[i] - ey, dz = z[i] - ez;
        return dx * dx + dy * dy + dz * dz;
    }
};

struct GivenDepth {
    const float* depths;
    float operator()(std::size_t i) const { return depths[i]; }
};

/// Ensures a capacity of `count` elements plus an eighth, so that a slowly growing cloud does not allocate each frame.
template <typename T>
void hold(LedgerVector<T>& memory, std::size_t count) {
    if (memory.size() >= count) return;
    memory.clear();  // no contents to copy
    memory.reserve(count + count / 8);
    memory.resize(count + count / 8);
}

}  // namespace

DepthSort::DepthSort(MemoryLedger& ledger)
    : front_(ledger.account("depth sort")),
      back_(ledger.account("depth sort")),
      counts_(ledger.account("depth sort")),
      order_(ledger.account("depth sort")) {}

void DepthSort::grow(SortKind kind, std::size_t count) {
    hold(order_, count);
    if (kind != SortKind::none) hold(front_, count);
    if (kind == SortKind::radix) {
        hold(back_, count);
        hold(counts_, radixCounts);
    }
}

template <typename Depth>
std::span<const std::uint32_t> DepthSort::sort(SortKind kind, std::size_t count, const Depth& depth) {
    grow(kind, count);
    const auto order = std::span(order_).first(count);
    switch (kind) {
        case SortKind::none:
            std::iota(order.begin(), order.end(), 0u);
            break;
        case SortKind::quicksort: {
            const auto elements = std::span(front_).first(count);
            for (std::size_t i = 0; i < count; ++i) elements[i] = keyedIndex(farFirstKey(depth(i)), i);
            quicksort(elements);
            for (std::size_t i = 0; i < count; ++i) order[i] = indexOf(elements[i]);
            break;
        }
        case SortKind::radix: {
            RadixSort(std::span(front_).first(count), std::span(back_).first(count), order, counts_, blocksFor(count))
                .sort(depth);
            break;
        }
    }
    return order;
}

std::span<const std::uint32_t> DepthSort::farToNear(SortKind kind, const PointColumns& points, const glm::vec3& eye) {
    const std::size_t count = points.x.size();
    if (points.y.size() != count || points.z.size() != count)
        throw std::invalid_argument("depth sort: got columns of " + std::to_string(count) + ", " +
                                    std::to_string(points.y.size()) + " and " + std::to_string(points.z.size()) +
                                    " points, expected the same number");
    return sort(kind, count, SquaredDistance{points.x.data(), points.y.data(), points.z.data(), eye.x, eye.y, eye.z});
}

std::span<const std::uint32_t> DepthSort::farToNear(SortKind kind, std::span<const float> depths) {
    return sort(kind, depths.size(), GivenDepth{depths.data()});
}

}  // namespace dustbench::draw
