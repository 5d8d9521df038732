#include "methods/kit/draw/depth_sort_quicksort.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace dustbench::draw {
namespace {

constexpr std::ptrdiff_t insertionLength = 24;

void insertionSort(std::uint64_t* first, std::uint64_t* last) {
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

}  // namespace

void quicksort(std::span<std::uint64_t> values) {
    const int splits = 2 * static_cast<int>(std::bit_width(values.size()));
    sortRange(values.data(), values.data() + values.size(), splits);
}

}  // namespace dustbench::draw
