#include "methods/volume/sparse/nano_tree.h"

#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <tuple>

#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::volume {
namespace {

using Root = nanovdb::NanoRoot<float>::DataType;
using Upper = nanovdb::NanoUpper<float>::DataType;
using Lower = nanovdb::NanoLower<float>::DataType;
using Leaf = nanovdb::NanoLeaf<float>::DataType;

nanovdb::Coord coordOf(const glm::ivec3& cell) {
    return {cell.x, cell.y, cell.z};
}

/// A brick's position in the tree's order: its root key, then its indices in the nodes below.
struct Place {
    std::uint64_t key;
    std::uint32_t inUpper, inLower;
    bool operator==(const Place&) const = default;
};

Place placeOf(const glm::ivec3& brick) {
    const nanovdb::Coord first = coordOf(brick * brickEdge);
    return {Root::CoordToKey(first), nanovdb::NanoUpper<float>::CoordToOffset(first),
            nanovdb::NanoLower<float>::CoordToOffset(first)};
}

struct Counts {
    std::size_t uppers = 0, lowers = 0, leaves = 0, tiles = 0;
};

Counts countNodes(const std::vector<TreeBrick>& bricks) {
    Counts counts;
    Place before{std::numeric_limits<std::uint64_t>::max(), 0, 0};
    for (const TreeBrick& brick : bricks) {
        const Place place = placeOf(brick.at);
        if (place.key != before.key) ++counts.uppers;
        if (place.key != before.key || place.inUpper != before.inUpper) ++counts.lowers;
        ++(brick.isLeaf ? counts.leaves : counts.tiles);
        before = place;
    }
    return counts;
}

/// Offsets of the first node of each kind.
struct Layout {
    explicit Layout(const Counts& counts)
        : tree(sizeof(nanovdb::GridData)),
          root(tree + sizeof(nanovdb::NanoTree<float>::DataType)),
          upper(root + sizeof(Root) + counts.uppers * sizeof(Root::Tile)),
          lower(upper + counts.uppers * sizeof(Upper)),
          leaf(lower + counts.lowers * sizeof(Lower)),
          end(leaf + counts.leaves * sizeof(Leaf)) {}
    std::size_t tree, root, upper, lower, leaf, end;
};

template <typename Node>
Node* nodeAt(std::byte* grid, std::size_t offset) {
    return reinterpret_cast<Node*>(grid + offset);
}

void fillHeader(std::byte* bytes, const Layout& layout, const Counts& counts, double spacing,
                const glm::dvec3& origin) {
    auto* const grid = nodeAt<nanovdb::GridData>(bytes, 0);
    grid->mMagic = NANOVDB_MAGIC_NUMBER;
    grid->mChecksum = std::numeric_limits<std::uint64_t>::max();  // none
    grid->mVersion = nanovdb::Version();
    grid->setFlagsOff();
    grid->setBBoxOn();
    grid->setBreadthFirstOn();
    grid->mGridCount = 1;
    grid->mGridSize = layout.end;
    std::strcpy(grid->mGridName, "density");
    const glm::dvec3 middle = origin + spacing / 2;  // of cell (0, 0, 0)
    grid->mMap.set(spacing, nanovdb::Vec3d(middle.x, middle.y, middle.z), 1.0);
    grid->mVoxelSize = nanovdb::Vec3d(spacing);
    grid->mGridClass = nanovdb::GridClass::FogVolume;
    grid->mGridType = nanovdb::GridType::Float;
    auto* const tree = nodeAt<nanovdb::NanoTree<float>::DataType>(bytes, layout.tree);
    tree->mNodeOffset[0] = counts.leaves > 0 ? layout.leaf - layout.tree : 0;
    tree->mNodeOffset[1] = layout.lower - layout.tree;
    tree->mNodeOffset[2] = layout.upper - layout.tree;
    tree->mNodeOffset[3] = layout.root - layout.tree;
    tree->mNodeCount[0] = static_cast<std::uint32_t>(counts.leaves);
    tree->mNodeCount[1] = static_cast<std::uint32_t>(counts.lowers);
    tree->mNodeCount[2] = static_cast<std::uint32_t>(counts.uppers);
    tree->mTileCount[0] = static_cast<std::uint32_t>(counts.tiles);
    tree->mVoxelCount = 0;
    nodeAt<Root>(bytes, layout.root)->mTableSize = static_cast<std::uint32_t>(counts.uppers);
}

/// Grows the node's bounds by those of a brick in it.
template <typename Node>
void grow(Node& node, const nanovdb::CoordBBox& box) {
    if (box.empty()) return;
    node.mBBox.expand(box.min());
    node.mBBox.expand(box.max());
}

/// The bounds of a brick's active cells.
nanovdb::CoordBBox boxOf(const TreeBrick& brick) {
    nanovdb::CoordBBox box;
    std::uint64_t any = 0;
    int low = brickEdge, high = -1;
    for (int x = 0; x < brickEdge; ++x) {
        const std::uint64_t word = brick.active[static_cast<std::size_t>(x)];
        if (word == 0) continue;
        low = std::min(low, x);
        high = x;
        any |= word;
    }
    if (any == 0) return box;
    std::uint64_t row = any;
    for (int shift = 8; shift < 64; shift *= 2) row |= row >> shift;
    row &= 0xff;
    const int lowZ = std::countr_zero(row), highZ = 63 - std::countl_zero(row);
    const int lowY = std::countr_zero(any) / 8, highY = (63 - std::countl_zero(any)) / 8;
    const glm::ivec3 first = brick.at * brickEdge;
    return {coordOf(first + glm::ivec3(low, lowY, lowZ)), coordOf(first + glm::ivec3(high, highY, highZ))};
}

InputError tooMuch(std::size_t bytes, std::size_t maximumBytes) {
    return InputError(
        fmt::format("storage=sparse: the tree of the volume takes {:.3g} GB, allowed: {:.3g} GB (limit of "
                    "volumes)",
                    static_cast<double>(bytes) / 1e9, static_cast<double>(maximumBytes) / 1e9));
}

// A word's bit 8·y + z is the cell (y, z).

constexpr std::uint64_t firstOfRows = 0x0101010101010101ull;

CellMask cellsWithDensity(const Bricks::Values& values) {
    CellMask mask{};
    for (int i = 0; i < brickCells; ++i)
        mask[static_cast<std::size_t>(i / 64)] |= std::uint64_t{values[static_cast<std::size_t>(i)] != 0} << (i % 64);
    return mask;
}

/// Also sets the cells directly below the set ones along an axis; `above` is the next brick upwards.
CellMask spreadX(const CellMask& mask, const CellMask& above) {
    CellMask spread = mask;
    for (std::size_t x = 0; x < 8; ++x) spread[x] |= x < 7 ? mask[x + 1] : above[0];
    return spread;
}
CellMask spreadY(const CellMask& mask, const CellMask& above) {
    CellMask spread = mask;
    for (std::size_t x = 0; x < 8; ++x) spread[x] |= mask[x] >> 8 | above[x] << 56;
    return spread;
}
CellMask spreadZ(const CellMask& mask, const CellMask& above) {
    CellMask spread = mask;
    for (std::size_t x = 0; x < 8; ++x) spread[x] |= (mask[x] & ~firstOfRows) >> 1 | (above[x] & firstOfRows) << 7;
    return spread;
}

bool any(const CellMask& mask) {
    return std::ranges::any_of(mask, [](std::uint64_t word) { return word != 0; });
}

/// The bricks of a tree for these densities. Fills `order`; a leaf's `source` is its index there.
std::vector<TreeBrick> treeBricks(const Bricks& densities, std::vector<std::uint64_t>& order) {
    for (const auto& [key, values] : densities.all()) order.push_back(key);
    std::vector<CellMask> filled(order.size());
    parallel::forEachBlock(order.size(), 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i)
            filled[i] = cellsWithDensity(*densities.find(brickOf(order[i])));
    });
    std::unordered_map<std::uint64_t, std::size_t> places;
    places.reserve(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) places.emplace(order[i], i);

    // All bricks that samples can read: those with density, and the seven below each.
    std::vector<TreeBrick> bricks;
    std::unordered_map<std::uint64_t, bool> seen;
    seen.reserve(2 * order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const glm::ivec3 brick = brickOf(order[i]);
        for (int n = 0; n < 8; ++n) {
            const glm::ivec3 below = brick - glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
            if (!seen.emplace(keyOf(below), true).second) continue;
            const auto own = places.find(keyOf(below));
            TreeBrick& made = bricks.emplace_back();
            made.at = below;
            made.isLeaf = own != places.end();
            if (made.isLeaf) made.source = own->second;
        }
    }
    parallel::forEachBlock(bricks.size(), 256, [&](std::size_t first, std::size_t count) {
        for (std::size_t b = first; b < first + count; ++b) {
            const auto maskOf = [&](int x, int y, int z) {
                const auto found = places.find(keyOf(bricks[b].at + glm::ivec3(x, y, z)));
                return found == places.end() ? CellMask{} : filled[found->second];
            };
            std::array<CellMask, 4> alongZ;  // of the four columns (x, y)
            for (int n = 0; n < 4; ++n)
                alongZ[static_cast<std::size_t>(n)] = spreadZ(maskOf(n & 1, n >> 1, 0), maskOf(n & 1, n >> 1, 1));
            bricks[b].active = spreadX(spreadY(alongZ[0], alongZ[2]), spreadY(alongZ[1], alongZ[3]));
        }
    });
    std::erase_if(bricks, [](const TreeBrick& brick) { return !brick.isLeaf && !any(brick.active); });
    return bricks;
}

/// Lays out these bricks and copies their values; a leaf's `source` is its index in `order`.
void plant(const Bricks& values, std::vector<TreeBrick> bricks, const std::vector<std::uint64_t>& order,
           double spacingMetres, const glm::dvec3& originMetres, std::size_t roomBytes, NanoTree& tree) {
    tree.lay(bricks, spacingMetres, originMetres, roomBytes);
    std::size_t leaf = 0;
    for (const TreeBrick& brick : bricks)
        if (brick.isLeaf) std::ranges::copy(*values.find(brickOf(order[brick.source])), tree.valuesOf(leaf++));
}

}  // namespace

void NanoTree::lay(std::vector<TreeBrick>& bricks, double spacingMetres, const glm::dvec3& originMetres,
                   std::size_t maximumBytes) {
    std::ranges::sort(bricks, {}, [](const TreeBrick& brick) {
        const Place place = placeOf(brick.at);
        return std::tuple(place.key, place.inUpper, place.inLower);
    });
    const Counts counts = countNodes(bricks);
    const Layout layout(counts);
    if (layout.end > maximumBytes) throw tooMuch(layout.end, maximumBytes);
    bytes_.clear();
    bytes_.shrink_to_fit();
    bytes_.resize(layout.end);
    leaves_.clear();
    leaves_.reserve(counts.leaves);
    tiles_.clear();
    tiles_.reserve(counts.tiles);
    leafOffset_ = layout.leaf;
    std::byte* const grid = bytes_.data();
    fillHeader(grid, layout, counts, spacingMetres, originMetres);
    auto* const root = nodeAt<Root>(grid, layout.root);
    auto* const tree = nodeAt<nanovdb::NanoTree<float>::DataType>(grid, layout.tree);
    auto* upper = nodeAt<Upper>(grid, layout.upper) - 1;
    auto* lower = nodeAt<Lower>(grid, layout.lower) - 1;
    auto* leaf = nodeAt<Leaf>(grid, layout.leaf);
    Root::Tile* tile = reinterpret_cast<Root::Tile*>(root + 1) - 1;
    root->mBBox = nanovdb::CoordBBox();
    Place before{std::numeric_limits<std::uint64_t>::max(), 0, 0};
    for (const TreeBrick& brick : bricks) {
        const Place place = placeOf(brick.at);
        const nanovdb::Coord first = coordOf(brick.at * brickEdge);
        if (place.key != before.key) {
            ++upper;
            (++tile)->setChild(first, reinterpret_cast<const nanovdb::NanoUpper<float>*>(upper), root);
            upper->mBBox = nanovdb::CoordBBox();
        }
        if (place.key != before.key || place.inUpper != before.inUpper) {
            ++lower;
            upper->mChildMask.setOn(place.inUpper);
            upper->setChild(place.inUpper, lower);
            lower->mBBox = nanovdb::CoordBBox();
        }
        const nanovdb::CoordBBox box = boxOf(brick);
        grow(*lower, box);
        grow(*upper, box);
        grow(*root, box);
        if (brick.isLeaf) {
            lower->mChildMask.setOn(place.inLower);
            lower->setChild(place.inLower, leaf);
            if (!box.empty()) {
                leaf->mBBoxMin = box.min();
                for (int axis = 0; axis < 3; ++axis)
                    leaf->mBBoxDif[axis] = static_cast<std::uint8_t>(box.max()[axis] - box.min()[axis]);
                leaf->mFlags = 2;  // it has a box
            } else {
                leaf->mBBoxMin = coordOf(brick.at * brickEdge);
            }
            for (int x = 0; x < brickEdge; ++x)
                leaf->mValueMask.getWord<std::uint64_t>(x) = brick.active[static_cast<std::size_t>(x)];
            tree->mVoxelCount += leaf->mValueMask.countOn();
            leaves_.push_back(brick.at);
            ++leaf;
        } else {
            lower->mValueMask.setOn(place.inLower);
            tree->mVoxelCount += brickCells;
            tiles_.push_back(brick.at);
        }
        before = place;
    }
    minimum_ = maximum_ = glm::ivec3(0);
    if (root->mBBox.empty()) return;  // no cell is active
    for (int axis = 0; axis < 3; ++axis) {
        minimum_[axis] = root->mBBox.min()[axis];
        maximum_[axis] = root->mBBox.max()[axis] + 1;
    }
}

float* NanoTree::valuesOf(std::size_t leaf) {
    return nodeAt<Leaf>(bytes_.data(), leafOffset_ + leaf * sizeof(Leaf))->mValues;
}

const float* NanoTree::valuesOf(std::size_t leaf) const {
    return reinterpret_cast<const Leaf*>(bytes_.data() + leafOffset_ + leaf * sizeof(Leaf))->mValues;
}

std::vector<TreeBrick> NanoTree::bricks() const {
    std::vector<TreeBrick> bricks;
    bricks.reserve(leaves_.size() + tiles_.size());
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        TreeBrick& brick = bricks.emplace_back(TreeBrick{leaves_[i], true, {}, i});
        const auto* const leaf = reinterpret_cast<const Leaf*>(bytes_.data() + leafOffset_ + i * sizeof(Leaf));
        for (int x = 0; x < brickEdge; ++x)
            brick.active[static_cast<std::size_t>(x)] = leaf->mValueMask.getWord<std::uint64_t>(x);
    }
    for (const glm::ivec3& tile : tiles_) bricks.emplace_back(TreeBrick{tile, false, {}, 0}).active.fill(~0ull);
    return bricks;
}

double NanoTree::sum() const {
    double sum = 0;
    for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf)
        for (const float value : std::span(valuesOf(leaf), brickCells)) sum += static_cast<double>(value);
    return sum;
}

void plantDensities(const Bricks& densities, double spacingMetres, const glm::dvec3& originMetres,
                    std::size_t roomBytes, NanoTree& tree) {
    std::vector<std::uint64_t> order;
    std::vector<TreeBrick> bricks = treeBricks(densities, order);
    plant(densities, std::move(bricks), order, spacingMetres, originMetres, roomBytes, tree);
}

void plantAll(const Bricks& values, double spacingMetres, const glm::dvec3& originMetres, std::size_t roomBytes,
              NanoTree& tree) {
    std::vector<std::uint64_t> order;
    std::vector<TreeBrick> bricks;
    for (const auto& [key, ignored] : values.all()) {
        bricks.push_back({brickOf(key), true, {}, order.size()});
        bricks.back().active.fill(~std::uint64_t{0});
        order.push_back(key);
    }
    plant(values, std::move(bricks), order, spacingMetres, originMetres, roomBytes, tree);
}

bool touchesAbove(const CellMask& active, int axes) {
    std::uint64_t cells = ~std::uint64_t{0};
    if (axes & 2) cells &= 0xffull << 56;
    if (axes & 4) cells &= 0x8080808080808080ull;
    for (std::size_t x = axes & 1 ? 7 : 0; x < 8; ++x)
        if (active[x] & cells) return true;
    return false;
}

}  // namespace dustbench::volume
