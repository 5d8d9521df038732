// VTK's own readers read back what was written, and where it comes from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkVariant.h>
#include <vtkXMLHyperTreeGridReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <functional>
#include <map>

#include "bench/export/format_writers.h"
#include "bench/export/test_clouds.h"
#include "bench/measure/provenance.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {
namespace fs = std::filesystem;

constexpr double vtkSeconds = 2.0 + 1.0 / 60;

void expectTime(vtkDataObject& data) {
    vtkDataArray* time = data.GetFieldData()->GetArray("TimeValue");
    ASSERT_NE(time, nullptr);
    EXPECT_EQ(time->GetTuple1(0), vtkSeconds);
}

/// Every array except `serial` has a unit.
void expectUnits(vtkDataObject& data, vtkFieldData& arrays) {
    EXPECT_GT(arrays.GetNumberOfArrays(), 0);
    for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
        const std::string name = arrays.GetArrayName(i);
        if (name == "serial") continue;
        vtkAbstractArray* unit = data.GetFieldData()->GetAbstractArray((name + "_unit").c_str());
        ASSERT_NE(unit, nullptr) << name;
        EXPECT_FALSE(unit->GetVariantValue(0).ToString().empty()) << name;
    }
}

template <typename Reader>
void read(Reader& reader, const fs::path& file) {
    ASSERT_TRUE(reader.CanReadFile(file.c_str()));
    reader.SetFileName(file.c_str());
    reader.Update();
    ASSERT_EQ(reader.GetErrorCode(), 0u);
}

TEST(VtiFile, ReadsBackEqual) {
    const TestFolder folder;
    const CollectedVolume volume = TestDust(500, 10, 0.1f, 1).volume();
    const ExtinctionGrid grid = computeGrid(volume, planGrid(volume.bounds(), 45));
    writeVti(grid, vtkSeconds, folder.path() / "a.vti");

    vtkNew<vtkXMLImageDataReader> reader;
    read(*reader, folder.path() / "a.vti");
    vtkImageData& image = *reader->GetOutput();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(image.GetOrigin()[axis], grid.plan.origin[axis]);
        EXPECT_EQ(image.GetSpacing()[axis], grid.plan.spacingMetres);
        EXPECT_EQ(image.GetDimensions()[axis], grid.plan.cells[static_cast<std::size_t>(axis)] + 1);
    }
    vtkDataArray* extinction = image.GetCellData()->GetArray("extinction");
    ASSERT_EQ(extinction->GetDataType(), VTK_FLOAT);
    ASSERT_EQ(extinction->GetNumberOfTuples(), grid.plan.cellCount());
    for (vtkIdType cell = 0; cell < extinction->GetNumberOfTuples(); ++cell)
        ASSERT_EQ(static_cast<float>(extinction->GetTuple1(cell)),
                  grid.extinctionPerMetre[static_cast<std::size_t>(cell)]);
    expectTime(image);
    expectUnits(image, *image.GetCellData());

    // Position of the densest cell in the world, as computed by VTK.
    const auto densest = std::ranges::max_element(grid.extinctionPerMetre) - grid.extinctionPerMetre.begin();
    double bounds[6];
    image.GetCellBounds(densest, bounds);
    const auto i = densest % grid.plan.cells[0], j = densest / grid.plan.cells[0] % grid.plan.cells[1],
               k = densest / grid.plan.cells[0] / grid.plan.cells[1];
    const glm::dvec3 corner = grid.plan.origin + grid.plan.spacingMetres * glm::dvec3(i, j, k);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(bounds[2 * axis], corner[axis], 1e-9);
}

TEST(VtiFile, OfAnEmptyCloudCanBeRead) {
    const TestFolder folder;
    writeVti(computeGrid(CollectedVolume(), planGrid({}, 128)), vtkSeconds, folder.path() / "a.vti");
    vtkNew<vtkXMLImageDataReader> reader;
    read(*reader, folder.path() / "a.vti");
    EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 1);
}

TEST(VtpFile, ReadsBackEqual) {
    const TestFolder folder;
    const TestDust dust(1234, 10, 0.1f, 2);
    writeVtp(dust.store, vtkSeconds, folder.path() / "a.vtp");
    vtkNew<vtkXMLPolyDataReader> reader;
    read(*reader, folder.path() / "a.vtp");
    vtkPolyData& cloud = *reader->GetOutput();
    ASSERT_EQ(cloud.GetNumberOfPoints(), 1234);
    EXPECT_EQ(cloud.GetNumberOfVerts(), 1234);
    expectTime(cloud);
    expectUnits(cloud, *cloud.GetPointData());
    const auto column = [&](const char* name, int component, const auto& expected) {
        vtkDataArray* array = cloud.GetPointData()->GetArray(name);
        ASSERT_NE(array, nullptr) << name;
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(array->GetComponent(static_cast<vtkIdType>(i), component), static_cast<double>(expected[i]))
                << name;
    };
    column("serial", 0, dust.store.serial);
    column("age", 0, dust.store.age);
    column("lifetime", 0, dust.store.lifetime);
    column("radius", 0, dust.store.radius);
    column("opacity", 0, dust.store.opacity);
    column("velocity", 0, dust.store.velocityX);
    column("velocity", 1, dust.store.velocityY);
    column("velocity", 2, dust.store.velocityZ);
    for (std::size_t i = 0; i < dust.store.size(); ++i) {
        const double* point = cloud.GetPoint(static_cast<vtkIdType>(i));
        ASSERT_EQ(glm::vec3(point[0], point[1], point[2]), dust.store.position(i));
    }
}

TEST(VtpFile, OfNoParticlesCanBeRead) {
    const TestFolder folder;
    writeVtp(TestDust(0, 1, 1, 1).store, vtkSeconds, folder.path() / "a.vtp");
    vtkNew<vtkXMLPolyDataReader> reader;
    read(*reader, folder.path() / "a.vtp");
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_NE(reader->GetOutput()->GetPointData()->GetArray("serial"), nullptr);
}

struct Node {
    glm::dvec3 centre{0};
    double edge = 0;
    bool leaf = false;
    int depth = 0;
    std::map<std::string, double> values;
};

/// Every node as reported by VTK's geometry cursor.
std::vector<Node> nodesOf(vtkHyperTreeGrid& grid) {
    std::vector<Node> nodes;
    vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> cursor;
    cursor->Initialize(&grid, 0);
    const std::function<void()> visit = [&] {
        Node node;
        double bounds[6];
        cursor->GetBounds(bounds);
        node.centre = {(bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (bounds[4] + bounds[5]) / 2};
        node.edge = bounds[1] - bounds[0];
        node.leaf = cursor->IsLeaf();
        node.depth = static_cast<int>(cursor->GetLevel());
        for (const char* name : {"extinction", "own_extinction", "opacity", "age", "level"})
            node.values[name] = grid.GetCellData()->GetArray(name)->GetTuple1(cursor->GetGlobalNodeIndex());
        nodes.push_back(node);
        if (node.leaf) return;
        EXPECT_EQ(cursor->GetNumberOfChildren(), 8);
        for (unsigned char child = 0; child < 8; ++child) {
            cursor->ToChild(child);
            visit();
            cursor->ToParent();
        }
    };
    visit();
    return nodes;
}

/// Brute-force search over all voxels: those that contain a position.
std::vector<OctreeVoxel> voxelsOver(const CollectedOctree& octree, const glm::dvec3& place) {
    std::vector<OctreeVoxel> over;
    for (const OctreeVoxel& voxel : octree.voxels) {
        const glm::dvec3 from = place - octree.minimumCorner(voxel);
        const double edge = octree.cellEdgeMetres(voxel.level);
        if (from.x >= 0 && from.y >= 0 && from.z >= 0 && from.x < edge && from.y < edge && from.z < edge)
            over.push_back(voxel);
    }
    return over;
}

void expectLeaf(const CollectedOctree& octree, const Node& leaf) {
    double extinction = 0, own = 0;
    float age = NAN;
    int level = -1;
    for (const OctreeVoxel& voxel : voxelsOver(octree, leaf.centre)) {
        extinction += static_cast<double>(voxel.extinctionPerMetre);
        if (voxel.level == leaf.depth) own = static_cast<double>(voxel.extinctionPerMetre);
        age = std::fmin(age, voxel.ageSeconds);
        level = std::max(level, voxel.level);
    }
    EXPECT_NEAR(leaf.values.at("extinction"), extinction, 1e-12);
    EXPECT_EQ(leaf.values.at("own_extinction"), own);
    EXPECT_NEAR(leaf.values.at("opacity"), 1 - std::exp(-extinction * leaf.edge), 1e-12);
    EXPECT_EQ(leaf.values.at("level"), level);
    if (level < 0)
        EXPECT_TRUE(std::isnan(leaf.values.at("age")));
    else
        EXPECT_EQ(leaf.values.at("age"), static_cast<double>(age));
}

class HtgFile : public testing::TestWithParam<std::tuple<std::size_t, int, int>> {};

TEST_P(HtgFile, LeavesHoldAllVoxelsOverThemAndEveryDepthKeepsTheMass) {
    const auto [count, depth, levels] = GetParam();
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const CollectedOctree octree = testOctree(count, depth, levels, seed);
        const TestFolder folder;
        writeHtg(octree, vtkSeconds, folder.path() / "a.htg");
        vtkNew<vtkXMLHyperTreeGridReader> reader;
        read(*reader, folder.path() / "a.htg");
        auto* grid = vtkHyperTreeGrid::SafeDownCast(reader->GetOutput());
        ASSERT_NE(grid, nullptr);
        const std::string text = files::wholeText(folder.path() / "a.htg", "an octree");  // VTK 9.1 does not read it
        for (const char* name : {"extinction", "own_extinction", "opacity", "age", "level"})
            EXPECT_NE(text.find("Name=\"" + std::string(name) + "_unit\""), std::string::npos) << name;
        double bounds[6];
        grid->GetBounds(bounds);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(bounds[2 * axis], octree.originMetres[axis]);
            EXPECT_EQ(bounds[2 * axis + 1], octree.originMetres[axis] + octree.edgeMetres);
        }
        const double mass = massSquareMetres(octree);
        double leaves = 0, own = 0;
        for (const Node& node : nodesOf(*grid)) {
            const double volume = std::pow(node.edge, 3);
            own += node.values.at("own_extinction") * volume;
            if (node.depth == 0) {
                EXPECT_NEAR(node.values.at("extinction") * volume, mass, 1e-6 * mass);
            }
            if (!node.leaf) continue;
            leaves += node.values.at("extinction") * volume;
            expectLeaf(octree, node);
        }
        EXPECT_NEAR(leaves, mass, 1e-6 * mass);
        EXPECT_NEAR(own, mass, 1e-6 * mass);
    }
}

INSTANTIATE_TEST_SUITE_P(RandomTrees, HtgFile,
                         testing::Values(std::tuple(0, 8, 4), std::tuple(1, 4, 1), std::tuple(1, 8, 9),
                                         std::tuple(40, 4, 5), std::tuple(200, 6, 3), std::tuple(150, 12, 4)));

TEST(HtgFileOf, VoxelsInAnotherOrderIsRefused) {
    const TestFolder folder;
    CollectedOctree octree = testOctree(50, 5, 2, 1);
    std::ranges::reverse(octree.voxels);
    EXPECT_THROW(writeHtg(octree, 0, folder.path() / "a.htg"), std::logic_error);
    octree = testOctree(1, 5, 1, 1);
    octree.voxels.push_back(octree.voxels.front());
    EXPECT_THROW(writeHtg(octree, 0, folder.path() / "a.htg"), std::logic_error);
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

// --- Where a file comes from

constexpr double originSeconds = 2.0 + 1.0 / 60;
const std::vector<std::string> someSettings{"scene=plain", "at=1s:size=2 <&> \"é\""};

template <typename Reader>
vtkDataObject& readOrigin(Reader& reader, const std::filesystem::path& file) {
    reader.SetFileName(file.c_str());
    reader.Update();
    return *reader.GetOutput();
}

void expectOrigin(vtkDataObject& data) {
    const auto texts = [&](const char* name) {
        std::vector<std::string> list;
        vtkAbstractArray* array = data.GetFieldData()->GetAbstractArray(name);
        for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
            list.push_back(array->GetVariantValue(i).ToString());
        return list;
    };
    EXPECT_EQ(texts("method"), std::vector<std::string>{"octree_search"});
    EXPECT_EQ(texts("configuration"), someSettings);
    EXPECT_EQ(texts("dustbench_version"), std::vector<std::string>{measure::buildFacts().version});
    vtkDataArray* const time = data.GetFieldData()->GetArray("TimeValue");
    ASSERT_NE(time, nullptr);
    EXPECT_EQ(time->GetTuple1(0), originSeconds);
}

TEST(FileOrigin, IsInEveryFormatOfVtk) {
    const TestFolder folder;
    const FileOrigin origin(originSeconds, "octree_search", someSettings);
    const TestDust dust(20, 3, 0.1f, 1);
    const CollectedVolume volume = dust.volume();
    writeVti(computeGrid(volume, planGrid(volume.bounds(), 8)), origin, folder.path() / "a.vti");
    vtkNew<vtkXMLImageDataReader> grid;
    expectOrigin(readOrigin(*grid, folder.path() / "a.vti"));

    writeVtp(dust.store, origin, folder.path() / "a.vtp", std::vector<int>(20, 3));
    vtkNew<vtkXMLPolyDataReader> points;
    expectOrigin(readOrigin(*points, folder.path() / "a.vtp"));
    EXPECT_EQ(points->GetOutput()->GetPointData()->GetArray("system")->GetTuple1(19), 3);
    EXPECT_NE(points->GetOutput()->GetFieldData()->GetAbstractArray("system_unit"), nullptr);

    writeHtg({{0, 0, 0}, 1, 0, {}}, origin, folder.path() / "a.htg");
    const std::string text = files::wholeText(folder.path() / "a.htg", "an octree");  // VTK 9.1 does not read it
    for (const char* name : {"method", "configuration", "dustbench_version", "TimeValue"})
        EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
}

}  // namespace
}  // namespace dustbench::exports
