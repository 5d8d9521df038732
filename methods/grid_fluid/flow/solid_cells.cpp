#include "methods/grid_fluid/flow/solid_cells.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// The six neighbours of a cell.
std::array<std::ptrdiff_t, 6> around(const CellLayout& layout) {
    const auto row = static_cast<std::ptrdiff_t>(layout.row), slab = static_cast<std::ptrdiff_t>(layout.slab);
    return {-1, 1, -row, row, -slab, slab};
}

}  // namespace

SolidCells::SolidCells(const CellLayout& layout, const Sides& sides, MemoryAccount& account)
    : layout_(layout), conductance_(account) {
    conductance_.resize(layout.padded());
    conductEverywhere(layout, sides, conductance_);
    rimOfSlab_.resize(static_cast<std::size_t>(layout.nz));
    besideOfSlab_.resize(static_cast<std::size_t>(layout.nz));
}

double SolidCells::set(const SolidMask& mask, CellField& cells) {
    check(mask, layout_);
    const auto width = static_cast<std::size_t>(layout_.nx);
    std::vector<float> covered(layout_.rows());
    parallel::forEachBlock(layout_.rows(), 64, [&](std::size_t first, std::size_t rows) {
        for (std::size_t r = first; r < first + rows; ++r) {
            const std::size_t at = layout_.at(0, layout_.rowJ(r), layout_.rowK(r));
            std::uint8_t* conductance = conductance_.data() + at;
            if (mask.body.empty()) {
                std::memset(conductance, 1, width);
                continue;
            }
            const std::uint8_t* body = mask.body.data() + r * width;
            std::uint8_t any = 0;
            for (std::size_t i = 0; i < width; ++i) {
                conductance[i] = body[i] == 0 ? 1 : 0;
                any |= body[i];
            }
            if (any == 0) continue;
            for (std::size_t i = 0; i < width; ++i) {
                if (body[i] == 0) continue;
                const std::size_t n = body[i] - std::size_t{1};
                const glm::vec3 velocity =
                    n < mask.motions.size()
                        ? mask.motions[n].velocityAt(static_cast<int>(i), layout_.rowJ(r), layout_.rowK(r))
                        : glm::vec3(0);
                float* record = cells.cell(at + i);
                covered[r] += record[density];
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    record[lane] = lane < 3 ? velocity[static_cast<int>(lane)] : 0;
            }
        }
    });
    findEdges(cells);
    return std::accumulate(covered.begin(), covered.end(), 0.0);
}

void SolidCells::findEdges(const CellField& cells) {
    const auto neighbours = around(layout_);
    const auto row = static_cast<std::ptrdiff_t>(layout_.row), slab = static_cast<std::ptrdiff_t>(layout_.slab);
    parallel::forEachBlock(static_cast<std::size_t>(layout_.nz), 1, [&](std::size_t k, std::size_t) {
        auto& rim = rimOfSlab_[k];
        auto& beside = besideOfSlab_[k];
        rim.clear();
        beside.clear();
        for (int j = 0; j < layout_.ny; ++j) {
            const std::size_t first = layout_.at(0, j, static_cast<int>(k));
            const std::uint8_t* own = conductance_.data() + first;
            // 64 cells at once: all fluid beside fluid or open sides, or all solid beside solid, has no edge.
            for (int start = 0; start < layout_.nx; start += 64) {
                const int end = std::min(start + 64, layout_.nx);
                std::uint8_t edge = 0;
                for (int i = start; i < end; ++i) {
                    const std::uint8_t minimum =
                        std::min({own[i - 1], own[i + 1], own[i - row], own[i + row], own[i - slab], own[i + slab]});
                    const auto any = static_cast<std::uint8_t>(own[i - 1] | own[i + 1] | own[i - row] | own[i + row] |
                                                               own[i - slab] | own[i + slab]);
                    edge |= own[i] == 1 ? std::uint8_t{minimum == 0} : static_cast<std::uint8_t>(any & 1);
                }
                if (edge == 0) continue;
                for (int i = start; i < end; ++i) {
                    const auto blocked = [&](std::ptrdiff_t to) { return own[i + to] == 0; };
                    const auto fluid = [&](std::ptrdiff_t to) { return own[i + to] == 1; };
                    const auto at = static_cast<std::uint32_t>(first + static_cast<std::size_t>(i));
                    if (own[i] == 1 && std::any_of(neighbours.begin(), neighbours.end(), blocked))
                        beside.push_back(at);
                    else if (own[i] != 1 && std::any_of(neighbours.begin(), neighbours.end(), fluid))
                        rim.push_back(at);
                }
            }
        }
    });
    rim_.clear();
    besideBlocked_.clear();
    for (std::size_t k = 0; k < rimOfSlab_.size(); ++k) {
        for (const std::uint32_t at : rimOfSlab_[k]) {
            const float* record = cells.cell(at);
            rim_.push_back({at, {record[0], record[1], record[2]}});
        }
        besideBlocked_.insert(besideBlocked_.end(), besideOfSlab_[k].begin(), besideOfSlab_[k].end());
    }
}

void SolidCells::extendInto(CellField& cells, bool slip) const {
    const auto neighbours = around(layout_);
    parallel::forEachBlock(rim_.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            float* own = cells.cell(rim_[r].at);
            std::array<float, lanes> sum{};
            float found = 0;
            for (const std::ptrdiff_t to : neighbours) {
                if (conductance_[static_cast<std::size_t>(rim_[r].at + to)] != 1) continue;
                const float* other = own + to * static_cast<std::ptrdiff_t>(lanes);
                for (std::size_t lane = 0; lane < lanes; ++lane) sum[lane] += other[lane];
                found += 1;
            }
            for (std::size_t lane = slip ? 0 : 3; lane < lanes; ++lane) own[lane] = sum[lane] / found;
        }
    });
}

void SolidCells::restore(CellField& cells) const {
    for (const Rim& rim : rim_) {
        float* record = cells.cell(rim.at);
        for (int lane = 0; lane < 3; ++lane) record[lane] = rim.velocity[lane];
        record[density] = record[temperature] = record[reaction] = 0;
    }
}

}  // namespace dustbench::grid_fluid::flow
