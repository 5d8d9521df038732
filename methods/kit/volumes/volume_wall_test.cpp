// A table of volumes as other programs write them: mass, centroid and first value of each, and the ignored parts.
//
// OpenVDB's own Python module makes the files, one script for all of them, with the names, classes and settings of the
// programs that the rows name. VTK's writers are in vti_file_test.cpp, NanoVDB's in nano_volume_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "methods/kit/files/input_log.h"
#include "methods/kit/testing/python_script.h"
#include "methods/kit/volumes/volume_file.h"

namespace dustbench::volumes {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

/// Every density is 1 + x + 10 y + 100 z in a block of 4x3x2 voxels of 0.5, unless the row says otherwise.
constexpr const char* makeVdbs = R"(
import sys, numpy, pyopenvdb as vdb
folder = sys.argv[1] + '/'
values = numpy.array([[[1 + x + 10 * y + 100 * z for z in range(2)] for y in range(3)] for x in range(4)], numpy.float32)

def scalar(name, factor=1, where=(0, 0, 0), size=0.5, kind='fog volume', background=0):
    grid = vdb.FloatGrid(background)
    grid.copyFromArray(values * factor, ijk=where)
    grid.name = name
    grid.gridClass = kind
    grid.transform = vdb.createLinearTransform(voxelSize=size)
    return grid

def vector(name, kind='staggered', size=0.5):
    grid = vdb.Vec3SGrid()
    grid.copyFromArray(numpy.stack([values, values, values], axis=-1))
    grid.name = name
    grid.gridClass = kind
    grid.transform = vdb.createLinearTransform(voxelSize=size)
    return grid

def mask(name):
    grid = vdb.BoolGrid(False)
    grid.fill((0, 0, 0), (3, 2, 1), True)
    grid.name = name
    return grid

def write(name, grids, metadata=None):
    vdb.write(folder + name, grids=grids, metadata=metadata or {})

write('plain.vdb', [scalar('density')])
half = scalar('density')
half.saveFloatAsHalf = True
write('half.vdb', [half])
moved = scalar('density')
moved.transform.translate((10, 20, -5))
write('translated.vdb', [moved])
write('offset.vdb', [scalar('density', where=(-70, 5, 1000))])
write('unnamed.vdb', [scalar('')])
write('unknown_class.vdb', [scalar('density', kind='unknown')])
write('blender.vdb', [scalar('density'), scalar('heat', 2), scalar('flame', 3), scalar('fuel', 4), scalar('shadow', 5),
                      vector('velocity'), vector('color', 'unknown')], {'creator': 'Blender/Smoke'})
write('mantaflow.vdb', [scalar('phiObsIn_grid', 7), scalar('density'), vector('vel')])
write('houdini.vdb', [scalar('density'), scalar('temperature', 2), scalar('burn', 3), vector('vel'),
                      vector('rest', 'unknown')], {'file_creator': 'Houdini 19.5'})
write('houdini_components.vdb', [scalar('density'), scalar('vel.x'), scalar('vel.y'), scalar('vel.z')])
write('embergen.vdb', [scalar('density'), scalar('flames', 3), scalar('temperature', 2)])
write('mask.vdb', [mask('mask'), scalar('density')])
other = scalar('temperature', size=0.25)
write('other_lattice.vdb', [scalar('density'), other])
write('two_temperatures.vdb', [scalar('density'), scalar('temperature', 2), scalar('heat', 3, size=0.25)])
tiles = vdb.FloatGrid()
tiles.fill((0, 0, 0), (15, 7, 7), 2.0)
tiles.name = 'density'
tiles.transform = vdb.createLinearTransform(voxelSize=0.5)
write('tiles.vdb', [tiles])
sphere = vdb.createLevelSetSphere(radius=4, voxelSize=0.5)
sphere.name = 'surface'
write('level_set.vdb', [sphere])
off = scalar('density')
off.getAccessor().setValueOff((3, 2, 1), 214.0)
write('switched_off.vdb', [off])
write('smoke_and_density.vdb', [scalar('density'), scalar('smoke')])
write('twice.vdb', [scalar('density'), scalar('density', 2)])
turned = scalar('density')
turned.transform = vdb.createLinearTransform([[0.3, 0.4, 0, 0], [-0.4, 0.3, 0, 0], [0, 0, 0.5, 0], [0, 0, 0, 1]])
write('rotated.vdb', [turned])
oblong = scalar('density')
oblong.transform = vdb.createLinearTransform([[0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 0.25, 0], [0, 0, 0, 1]])
write('oblong.vdb', [oblong])
mirrored = scalar('density')
mirrored.transform = vdb.createLinearTransform([[-0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 0.5, 0], [0, 0, 0, 1]])
write('mirrored.vdb', [mirrored])
frustum = scalar('density')
frustum.transform = vdb.createFrustumTransform((0, 0, 0), (4, 4, 4), 0.5, 2, 0.5)
write('frustum.vdb', [frustum])
write('haze.vdb', [scalar('density', background=0.5)])
write('vectors_alone.vdb', [vector('density', 'unknown')])
)";

struct WallRow {
    const char* file;
    glm::ivec3 cells{4, 3, 2};
    double mass = 24 * 62.5 * 0.125;  ///< ∫ density dV: the mean is 1 + 1.5 + 10 + 50
    glm::dvec3 centroid{0};           ///< of the mass; 0: the one of `plain.vdb`
    float first = 1;                  ///< at the minimum corner
    bool hasTemperature = false, hasVelocity = false;
    std::vector<std::string> ignored{};
    double within = 1e-6;  ///< of the mass, relative
};

struct Seen {
    double mass = 0;
    glm::dvec3 centroid{0};
};

Seen seenIn(const VolumeGrid& grid) {
    Seen seen;
    const double volume = grid.spacing * grid.spacing * grid.spacing;
    for (int z = 0; z < grid.cells.z; ++z)
        for (int y = 0; y < grid.cells.y; ++y)
            for (int x = 0; x < grid.cells.x; ++x) {
                const double mass = volume * static_cast<double>(grid.density[grid.indexOf({x, y, z})]);
                seen.mass += mass;
                seen.centroid += mass * (grid.origin + grid.spacing * (glm::dvec3(x, y, z) + 0.5));
            }
    seen.centroid /= seen.mass;
    return seen;
}

/// The centroid of the block whose first voxel is centred at `first`.
glm::dvec3 blockAt(const glm::dvec3& first) {
    // By hand: Σ x·(1 + x + 10 y + 100 z) / Σ(…) for x = 0..3, y = 0..2, z = 0..1.
    return first + 0.5 * glm::dvec3(1.5 + 1.25 / 62.5, 1 + (10.0 * 2 / 3) / 62.5, 0.5 + (100 * 0.25) / 62.5);
}

TEST(VolumeWall, WhatOpenVdbsPythonWritesIsReadAsItsProgramsMeanIt) {
    const TestFolder folder;
    (void)python(folder, makeVdbs, folder.path());
    const std::vector<std::string> ofBlender{"grid 'flame'", "grid 'fuel'", "grid 'shadow'", "grid 'color'"};
    for (const WallRow& row : std::vector<WallRow>{
             {"plain.vdb"},
             {"half.vdb", {4, 3, 2}, 187.5, {}, 1, false, false, {}, 1e-3},
             {"translated.vdb", {4, 3, 2}, 187.5, blockAt({10, 20, -5})},
             {"offset.vdb", {4, 3, 2}, 187.5, blockAt({-35, 2.5, 500})},
             {"unnamed.vdb"},
             {"unknown_class.vdb"},
             {"blender.vdb", {4, 3, 2}, 187.5, {}, 1, true, true, ofBlender},
             {"mantaflow.vdb", {4, 3, 2}, 187.5, {}, 1, false, true, {"grid 'phiObsIn_grid'"}},
             {"houdini.vdb", {4, 3, 2}, 187.5, {}, 1, true, true, {"grid 'burn'", "grid 'rest'"}},
             {"houdini_components.vdb",
              {4, 3, 2},
              187.5,
              {},
              1,
              false,
              false,
              {"grid 'vel.x'", "grid 'vel.y'", "grid 'vel.z'"}},
             {"embergen.vdb", {4, 3, 2}, 187.5, {}, 1, true, false, {"grid 'flames'"}},
             {"mask.vdb", {4, 3, 2}, 187.5, {}, 1, false, false, {"grid 'mask'"}},
             {"other_lattice.vdb", {4, 3, 2}, 187.5, {}, 1, false, false, {"grid 'temperature'"}},
             {"two_temperatures.vdb", {4, 3, 2}, 187.5, {}, 1, true, false, {"grid 'heat'"}},
             {"tiles.vdb", {16, 8, 8}, 256, {3.75, 1.75, 1.75}, 2},
             // Fog of a ball of radius 4 whose rim of 1.5 m grows from 0 to 1: ∫ min((4 − r)/1.5, 1) dV.
             {"level_set.vdb", {0, 0, 0}, 151.45, {1e-9, 0, 0}, 0, false, false, {}, 0.02},
             {"switched_off.vdb", {4, 3, 2}, 187.5 - 124 * 0.125, {-1, 0, 0}, 1}}) {
        const files::InputLog log;
        const VolumeGrid read = readVolume(folder.path() / row.file, {});
        const Seen seen = seenIn(read);
        if (row.cells.x > 0) {
            EXPECT_EQ(read.cells, row.cells) << row.file;
        }
        EXPECT_NEAR(seen.mass, row.mass, row.within * row.mass) << row.file;
        if (row.centroid.x >= 0 || row.centroid.x < -1) {
            const glm::dvec3 expected = row.centroid == glm::dvec3(0) ? blockAt({0, 0, 0}) : row.centroid;
            EXPECT_NEAR(glm::length(seen.centroid - expected), 0, 1e-3) << row.file;
        }
        EXPECT_EQ(read.density.front(), row.first) << row.file;
        EXPECT_EQ(!read.temperature.empty(), row.hasTemperature) << row.file;
        EXPECT_EQ(!read.velocity.empty(), row.hasVelocity) << row.file;
        const auto ignored = log.ignored();
        if (row.ignored.empty()) {
            EXPECT_TRUE(ignored.empty()) << row.file << ": " << testing::PrintToString(ignored);
        } else {
            EXPECT_THAT(ignored.at(folder.path() / row.file), ElementsAreArray(row.ignored)) << row.file;
        }
    }
    for (const auto& [file, reason] : std::vector<std::pair<const char*, const char*>>{
             {"smoke_and_density.vdb", "more than one field of numbers for its density: density, smoke"},
             {"twice.vdb", "density (grid 1 of float), density (grid 2 of float)"},
             {"rotated.vdb", "its grid is turned"},
             {"oblong.vdb", "its cells are not cubes"},
             {"mirrored.vdb", "its grid is turned"},
             {"frustum.vdb", "its cells are not cubes"},
             {"haze.vdb", "the background is 0.5"},
             {"vectors_alone.vdb", "it has no field of numbers 'density'"}})
        EXPECT_THAT(inputError([&] { (void)readVolume(folder.path() / file, {}); }), HasSubstr(reason)) << file;
}

/// VTK's other kinds of data with the extension of image data, and files of other programs with their own extensions.
TEST(VolumeWall, WhatIsNoImageDataIsRefusedByWhatItIs) {
    const TestFolder folder;
    for (const char* kind : {"RectilinearGrid", "StructuredGrid", "UnstructuredGrid", "PolyData", "PImageData"})
        EXPECT_THAT(inputError([&] {
                        (void)readVolume(folder.write("a.vti", std::string("<VTKFile type=\"") + kind +
                                                                   "\" version=\"1.0\" byte_order=\"LittleEndian\"><" +
                                                                   kind + "></" + kind + "></VTKFile>"),
                                         {});
                    }),
                    HasSubstr(kind))
            << kind;
    for (const char* name : {"a.vtr", "a.vts", "a.vtu", "a.uni", "a.bgeo", "a.raw", "a.vtk"})
        EXPECT_THAT(inputError([&] { (void)readVolume(folder.write(name, "x"), {}); }),
                    HasSubstr("expected a file that ends in .vdb, .nvdb or .vti"))
            << name;
}

}  // namespace
}  // namespace dustbench::volumes
