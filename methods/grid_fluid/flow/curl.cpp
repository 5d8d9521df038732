#include "methods/grid_fluid/flow/curl.h"

#include <cmath>

#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/sixteen_records.h"

namespace dustbench::grid_fluid::flow {

CurlField::CurlField(const CellLayout& layout, std::span<float> memory) : layout_(layout) {
    float* free = memory.data();
    for (float*& speeds : speeds_) {
        speeds = free;
        free += layout.padded();
    }
    for (float*& curl : curl_) {
        curl = free;
        free += layout.rows() * static_cast<std::size_t>(layout.nx);
    }
}

void CurlField::findSpeeds(const CellField& cells, int k) {
    for (int j = -1; j <= layout_.ny; ++j) findSpeedsOfRow(cells, j, k);
    // Beyond the box along z only the speeds across it are needed.
    if (k == 0)
        for (int j = 0; j < layout_.ny; ++j) findSpeedsOfRow(cells, j, -1);
    if (k == layout_.nz - 1)
        for (int j = 0; j < layout_.ny; ++j) findSpeedsOfRow(cells, j, layout_.nz);
}

/// Includes the ghosts at both ends. A ghost beyond a far side lacks the next face along its axis, which is not needed.
void CurlField::findSpeedsOfRow(const CellField& cells, int j, int k) {
    const std::size_t first = layout_.at(-1, j, k), count = layout_.row;
    const float* own = cells.cell(first);
    const float* above = j < layout_.ny ? own + layout_.row * lanes : own;
    const float* behind = k < layout_.nz ? own + layout_.slab * lanes : own;
    float *x = speeds_[0] + first, *y = speeds_[1] + first, *z = speeds_[2] + first;
    std::size_t i = 0;
    if constexpr (sixteenAtOnce)
        for (; i + SixteenRecords::count <= count; i += SixteenRecords::count) {
            const std::size_t at = i * lanes;
            const SixteenRecords centre(own + at);
            store(x + i, (centre + SixteenRecords(own + at + lanes)).get<0>());
            store(y + i, (centre + SixteenRecords(above + at)).get<1>());
            store(z + i, (centre + SixteenRecords(behind + at)).get<2>());
        }
    for (; i < count; ++i) {
        const std::size_t at = i * lanes;
        x[i] = own[at] + own[at + lanes];
        y[i] = own[at + 1] + above[at + 1];
        z[i] = own[at + 2] + behind[at + 2];
    }
}

void CurlField::findCurl(const std::uint8_t* conductance, float spacingMetres, int k) {
    const float perFourCells = 0.25f / spacingMetres;
    const std::size_t row = layout_.row, slab = layout_.slab;
    for (int j = 0; j < layout_.ny; ++j) {
        const std::size_t first = layout_.at(0, j, k), to = this->row(j, k);
        const std::uint8_t* conducts = conductance + first;
        const float *u = speeds_[0] + first, *v = speeds_[1] + first, *w = speeds_[2] + first;
        float *x = curl_[0] + to, *y = curl_[1] + to, *z = curl_[2] + to;
#pragma GCC ivdep
        for (std::size_t i = 0; i < static_cast<std::size_t>(layout_.nx); ++i) {
            const float scale = conducts[i] == 1 ? perFourCells : 0.0f;
            x[i] = (((w + row)[i] - (w - row)[i]) - ((v + slab)[i] - (v - slab)[i])) * scale;
            y[i] = (((u + slab)[i] - (u - slab)[i]) - ((w + 1)[i] - (w - 1)[i])) * scale;
            z[i] = (((v + 1)[i] - (v - 1)[i]) - ((u + row)[i] - (u - row)[i])) * scale;
        }
    }
}

void CurlField::findLength(int k) {
    for (int j = 0; j < layout_.ny; ++j) {
        const std::size_t from = row(j, k);
        const float *x = curl_[0] + from, *y = curl_[1] + from, *z = curl_[2] + from;
        float* to = speeds_[0] + layout_.at(0, j, k);
#pragma GCC ivdep
        for (std::size_t i = 0; i < static_cast<std::size_t>(layout_.nx); ++i)
            to[i] = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    }
}

}  // namespace dustbench::grid_fluid::flow
