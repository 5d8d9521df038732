#include "methods/kit/volumes/openvdb/answer.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <cmath>
#include <fstream>
#include <vector>

#include "methods/kit/volumes/openvdb/dense_answer.h"

namespace dustbench::volumes {
namespace {

using openvdb::DoubleGrid, openvdb::FloatGrid, openvdb::Vec3SGrid;

struct Chosen {
    const WantedField* wanted;
    openvdb::GridBase::Ptr grid;
};

openvdb::GridPtrVec readGrids(const std::string& file) {
    // As in vdb_reader.cpp: the stream detects the end of a file.
    std::ifstream stream(file, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::Stream stored(stream, /*delayLoad=*/false);
    return *stored.getGrids();
}

/// 0: a type that is not read.
int numbersInCellOf(const openvdb::GridBase& grid) {
    if (grid.isType<Vec3SGrid>()) return 3;
    return grid.isType<FloatGrid>() || grid.isType<DoubleGrid>() ? 1 : 0;
}

FloatGrid::Ptr inFloats(const openvdb::GridBase::Ptr& grid) {
    if (FloatGrid::Ptr floats = openvdb::gridPtrCast<FloatGrid>(grid)) return floats;
    const auto doubles = openvdb::gridPtrCast<DoubleGrid>(grid);
    const auto floats = FloatGrid::create(static_cast<float>(doubles->background()));
    floats->setTree(std::make_shared<openvdb::FloatTree>(doubles->tree()));
    floats->setTransform(doubles->transformPtr());
    floats->insertMeta(*doubles);
    return floats;
}

/// Throws Refusal unless the cells are cubes aligned with the world's axes.
void requireUpright(const openvdb::GridBase& grid) {
    const double spacing = grid.voxelSize()[0];
    if (!grid.transform().isLinear() || !grid.hasUniformVoxels() || !(spacing > 0) || !std::isfinite(spacing))
        throw Refusal{"its cells are not cubes"};
    const openvdb::Vec3d origin = grid.indexToWorld(openvdb::Vec3d(0));
    for (int axis = 0; axis < 3; ++axis) {
        openvdb::Vec3d unit(0);
        unit[axis] = 1;
        if (!((grid.indexToWorld(unit) - origin - spacing * unit).length() <= 1e-5 * spacing))
            throw Refusal{"its grid is turned, expected one along the axes"};
    }
}

openvdb::CoordBBox boxOf(const FloatGrid& density, const VolumeFields& fields) {
    const openvdb::CoordBBox box = density.evalActiveVoxelBoundingBox();
    if (box.empty()) throw Refusal{"its density is zero everywhere"};
    if (countOf(box) > static_cast<double>(maximumCells(fields))) throw Refusal{tooManyCells(fields)};
    return box;
}

void putField(const WantedField& field, const openvdb::GridBase::Ptr& grid, const openvdb::CoordBBox& box) {
    put(columnOf(field));
    if (const auto vectors = openvdb::gridPtrCast<Vec3SGrid>(grid)) {
        forgetInactive(*vectors);
        putVectors(*vectors, box);
    } else {
        const FloatGrid::Ptr numbers = inFloats(grid);
        forgetInactive(*numbers);
        putDense<float>(*numbers, box);
    }
}

}  // namespace

void answerVolume(const std::string& file, const VolumeFields& fields) {
    const openvdb::GridPtrVec grids = readGrids(file);
    std::vector<PresentField> all;
    for (const openvdb::GridBase::Ptr& grid : grids)
        all.push_back({grid->getName(), numbersInCellOf(*grid),
                       "grid " + std::to_string(all.size() + 1) + " of " + grid->valueType()});
    const auto wanted = wantedFields(fields);
    std::vector<Chosen> chosen;
    std::vector<std::size_t> places;
    for (const WantedField& each : wanted) {
        std::vector<PresentField> present = all;
        if (!chosen.empty() && !each.isRequired)  // a field on another lattice counts as missing
            for (std::size_t i = 0; i < grids.size(); ++i)
                if (grids[i]->transform() != chosen[0].grid->transform()) present[i].components = 0;
        const int at = chosenField<Refusal>(each, present);
        if (at < 0) continue;
        places.push_back(static_cast<std::size_t>(at));
        chosen.push_back({&each, grids[places.back()]});
    }

    const FloatGrid::Ptr density = inFloats(chosen[0].grid);
    requireUpright(*density);
    const bool isLevelSet = density->getGridClass() == openvdb::GRID_LEVEL_SET;
    if (isLevelSet) openvdb::tools::sdfToFogVolume(*density);
    if (density->background() != 0.0f && !isLevelSet)
        throw Refusal{"its density continues beyond its grid: the background is " +
                      std::to_string(density->background()) + ", expected 0"};
    chosen[0].grid = density;
    for (const Chosen& each : chosen)
        if (each.grid->transform() != density->transform())
            throw Refusal{"its field '" + each.grid->getName() + "' is on a different grid from its density"};
    const openvdb::CoordBBox box = boxOf(*density, fields);
    VdbMessage message = messageOf(*density, box);
    message.columns = static_cast<std::int32_t>(chosen.size());
    putMessage(message, restOf(all, places));
    for (const Chosen& each : chosen) putField(*each.wanted, each.grid, box);
    finish();
}

}  // namespace dustbench::volumes
