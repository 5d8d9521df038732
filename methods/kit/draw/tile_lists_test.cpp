#include "methods/kit/draw/tile_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/draw/test_canvas.h"

namespace dustbench::draw {
namespace {

/// First and last pixel of a shape, inclusive.
struct PixelBox {
    int left, bottom, right, top;
};

constexpr gpu::ShaderFile boxesGlsl{"test/boxes.glsl", R"(
layout(std430, binding = 0) restrict readonly buffer Boxes { ivec4 boxes[]; };
ivec4 pixelsOf(uint shape) {
    ivec4 box = boxes[shape];
    return ivec4(max(box.xy, ivec2(0)), min(box.zw, picture.xy - 1));
}
)"};

class BoxLists {
 public:
    /// Shapes of every 8 × 8 tile, row by row, merged from the lists of all levels.
    std::vector<std::vector<std::uint32_t>> listed(const std::vector<PixelBox>& boxes, int width, int height,
                                                   bool numberOnGpu = false) {
        gpu::Device& device = TestCanvas::device();
        gpu::Buffer buffer(device, "boxes", std::max<std::size_t>(boxes.size(), 1) * sizeof(PixelBox));
        buffer.write(std::span<const PixelBox>(boxes));
        const auto count = static_cast<std::uint32_t>(boxes.size());
        const gpu::Buffer number(device, "number", std::span<const std::uint32_t>(&count, 1));
        if (numberOnGpu)
            lists_.build({count + 1'000, &number}, width, height, [&](gpu::Program&) { buffer.bindStorage(0); });
        else
            lists_.build({count, nullptr}, width, height, [&](gpu::Program&) { buffer.bindStorage(0); });

        std::vector<std::uint32_t> ranges(lists_.ranges().bytes() / sizeof(std::uint32_t));
        lists_.ranges().read(std::span(ranges));
        std::vector<std::uint32_t> shapes(lists_.shapesOfTiles().bytes() / sizeof(std::uint32_t));
        lists_.shapesOfTiles().read(std::span(shapes));
        entries_ = *std::ranges::max_element(ranges);
        std::vector<std::vector<std::uint32_t>> found;
        for (int row = 0; row < lists_.rows(); ++row)
            for (int column = 0; column < lists_.columns(); ++column) {
                std::vector<std::uint32_t> all;
                std::size_t below = 0;
                for (int level = 0; level < lists_.levels(); ++level) {
                    const int columns = ((width - 1) >> (level + 3)) + 1, rows = ((height - 1) >> (level + 3)) + 1;
                    const std::size_t tile =
                        below + static_cast<std::size_t>((row >> level) * columns + (column >> level));
                    const auto begin = shapes.begin() + ranges[2 * tile], end = shapes.begin() + ranges[2 * tile + 1];
                    EXPECT_TRUE(std::is_sorted(begin, end)) << "level " << level;
                    all.insert(all.end(), begin, end);
                    below += static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
                }
                std::ranges::sort(all);
                found.push_back(std::move(all));
            }
        return found;
    }
    [[nodiscard]] std::size_t entries() const { return entries_; }
    [[nodiscard]] const TileLists& lists() const { return lists_; }

 private:
    TileLists lists_{TestCanvas::device(), "boxes", {boxesGlsl}};
    std::size_t entries_ = 0;
};

std::vector<PixelBox> randomBoxes(std::size_t count, int width, int height) {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    std::vector<PixelBox> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const auto within = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
        const int largest = 1 << within(0, 10), left = within(-40, width + 40), bottom = within(-40, height + 40);
        boxes.push_back({left, bottom, left + within(-1, largest), bottom + within(-1, largest)});
    }
    return boxes;
}

/// Each tile lists each shape that reaches into it once, in order. Tiles of the last picture have numbers of more than
/// 16 bits.
TEST(TileLists, ListEveryShapeThatReachesIntoATile) {
    BoxLists lists;
    for (const auto& [width, height] : {std::pair{200, 120}, {8, 8}, {9, 17}, {1, 1}, {700, 30}, {3'000, 2'000}})
        for (const std::size_t count : {0u, 1u, 300u, 5'000u})
            for (const bool numberOnGpu : {false, true}) {
                if (static_cast<std::size_t>(width) * count > 4'000'000) continue;
                const std::vector<PixelBox> boxes = randomBoxes(count, width, height);
                const auto found = lists.listed(boxes, width, height, numberOnGpu);
                EXPECT_LE(lists.entries(), 4 * count);
                std::size_t tile = 0, missing = 0, twice = 0;
                for (int row = 0; row < lists.lists().rows(); ++row)
                    for (int column = 0; column < lists.lists().columns(); ++column, ++tile) {
                        const std::vector<std::uint32_t>& here = found[tile];
                        twice += std::ranges::adjacent_find(here) != here.end() ? 1 : 0;
                        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
                            const PixelBox& box = boxes[i];
                            const bool reaches = box.left <= std::min(box.right, 8 * column + 7) &&
                                                 box.right >= 8 * column && box.left < width &&
                                                 box.bottom <= std::min(box.top, 8 * row + 7) && box.top >= 8 * row &&
                                                 box.bottom < height;
                            missing += reaches && !std::ranges::binary_search(here, i) ? 1 : 0;
                        }
                    }
                EXPECT_EQ(missing, 0u) << width << 'x' << height << ' ' << count;
                EXPECT_EQ(twice, 0u) << width << 'x' << height << ' ' << count;
            }
}

/// A shape of at most eight pixels is listed in the tiles that it reaches into, and no others.
TEST(TileLists, AreExactForSmallShapes) {
    BoxLists lists;
    std::vector<PixelBox> boxes;
    boxes.reserve(64);
    for (int i = 0; i < 64; ++i) boxes.push_back({i, 2 * i, i + i % 8, 2 * i + 7});
    const auto found = lists.listed(boxes, 128, 256);
    std::size_t listed = 0, expected = 0;
    for (const auto& tile : found) listed += tile.size();
    for (const PixelBox& box : boxes)
        expected += static_cast<std::size_t>((box.right / 8 - box.left / 8 + 1) * (box.top / 8 - box.bottom / 8 + 1));
    EXPECT_EQ(listed, expected);
}

TEST(TileLists, RefuseMoreThanTheDeviceHolds) {
    TileLists lists(TestCanvas::device(), "boxes", {boxesGlsl});
    EXPECT_THROW(lists.build({0xfffffff0u, nullptr}, 64, 64, [](gpu::Program&) {}), InputError);
    EXPECT_THROW(lists.build({1, nullptr}, 40'000, 64, [](gpu::Program&) {}), InputError);
}

}  // namespace
}  // namespace dustbench::draw
