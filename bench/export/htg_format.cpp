#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedCursor.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkXMLHyperTreeGridWriter.h>

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "bench/export/exporter.h"
#include "bench/export/format_writers.h"
#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"

namespace dustbench::exports {
namespace {

/// Data of a node: from its ancestors on the way down, from its subtree on the way up.
struct Summary {
    double extinctionPerMetre = 0;
    float ageSeconds = std::numeric_limits<float>::quiet_NaN();
    int level = -1;

    void add(float age, int finest) {
        ageSeconds = std::fmin(ageSeconds, age);  // ignores NaN
        level = std::max(level, finest);
    }
};

class TreeBuilder {
 public:
    TreeBuilder(const CollectedOctree& octree, vtkHyperTreeGrid& grid) : octree_(octree) {
        grid.InitializeNonOrientedCursor(cursor_, 0, true);
        cursor_->SetGlobalIndexStart(0);
        extinction_->SetName("extinction");
        own_->SetName("own_extinction");
        opacity_->SetName("opacity");
        age_->SetName("age");
        level_->SetName("level");
        const std::span<const OctreeVoxel> left = build({0, 0, 0}, 0, octree.voxels, {}).rest;
        if (!left.empty()) throw std::logic_error("octree: voxels are not in pre-order");
        using Entry = std::pair<vtkDataArray*, const char*>;
        for (const auto& [array, unit] : {Entry{extinction_, "1/m"}, Entry{own_, "1/m"}, Entry{opacity_, "1"},
                                          Entry{age_, "s"}, Entry{level_, "1"}}) {
            grid.GetCellData()->AddArray(array);
            addUnit(grid, array->GetName(), unit);
        }
        grid.GetCellData()->SetActiveScalars("extinction");
    }

 private:
    struct Built {
        Summary summary;
        std::span<const OctreeVoxel> rest;  ///< voxels after the subtree
    };

    static bool isWithin(const OctreeVoxel& voxel, const glm::uvec3& cell, int level) {
        if (voxel.level < level) return false;
        const int deeper = voxel.level - level;
        return glm::uvec3(voxel.x >> deeper, voxel.y >> deeper, voxel.z >> deeper) == cell;
    }

    /// Builds the node at the cursor; `voxels` begin with those of the node, in pre-order.
    Built build(const glm::uvec3& cell, int level, std::span<const OctreeVoxel> voxels, Summary over) {
        const vtkIdType node = cursor_->GetGlobalNodeIndex();
        double own = 0;
        if (!voxels.empty() && voxels.front().level == level && isWithin(voxels.front(), cell, level)) {
            const OctreeVoxel& voxel = voxels.front();
            own = static_cast<double>(voxel.extinctionPerMetre);
            over.extinctionPerMetre += own;
            over.add(voxel.ageSeconds, voxel.level);
            voxels = voxels.subspan(1);
        }
        Summary summary = over;
        if (!voxels.empty() && isWithin(voxels.front(), cell, level)) {
            // A second voxel in the same cell would never find its child.
            if (voxels.front().level == level) throw std::logic_error("octree: two voxels of the same cell and level");
            cursor_->SubdivideLeaf();
            summary.extinctionPerMetre = 0;
            // Our child order is 4·x + 2·y + z; VTK's is x + 2·y + 4·z.
            for (unsigned child = 0; child < 8; ++child) {
                const glm::uvec3 half(child >> 2 & 1u, child >> 1 & 1u, child & 1u);
                cursor_->ToChild(static_cast<unsigned char>(half.x + 2 * half.y + 4 * half.z));
                const Built built = build(2u * cell + half, level + 1, voxels, over);
                cursor_->ToParent();
                voxels = built.rest;
                summary.extinctionPerMetre += built.summary.extinctionPerMetre / 8;
                summary.add(built.summary.ageSeconds, built.summary.level);
            }
        }
        extinction_->InsertValue(node, summary.extinctionPerMetre);
        own_->InsertValue(node, own);
        opacity_->InsertValue(node, -std::expm1(-summary.extinctionPerMetre * octree_.cellEdgeMetres(level)));
        age_->InsertValue(node, summary.ageSeconds);
        level_->InsertValue(node, summary.level);
        return {summary, voxels};
    }

    const CollectedOctree& octree_;
    vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor_;
    vtkNew<vtkDoubleArray> extinction_, own_, opacity_;  // double: sums over levels stay exact
    vtkNew<vtkFloatArray> age_;
    vtkNew<vtkIntArray> level_;
};

vtkNew<vtkDoubleArray> ends(double minimum, double edge) {
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->InsertNextValue(minimum);
    coordinates->InsertNextValue(minimum + edge);
    return coordinates;
}

}  // namespace

void writeHtg(const CollectedOctree& octree, const FileOrigin& origin, const std::filesystem::path& file) {
    vtkNew<vtkHyperTreeGrid> grid;
    grid->SetBranchFactor(2);
    grid->SetDimensions(2, 2, 2);
    grid->SetXCoordinates(ends(octree.originMetres.x, octree.edgeMetres));
    grid->SetYCoordinates(ends(octree.originMetres.y, octree.edgeMetres));
    grid->SetZCoordinates(ends(octree.originMetres.z, octree.edgeMetres));
    const TreeBuilder builder(octree, *grid);
    stampOrigin(*grid, origin);

    WholeFile whole(file);
    vtkNew<vtkXMLHyperTreeGridWriter> writer;
    // Not appended: VTK 9.1 would write every cell array except the last over the beginning of the file.
    writeVtk(*writer, *grid, whole.temporaryPath(), Numbers::within);
    whole.publish();
}

namespace htg_format {

Exporter describe() {
    Exporter exporter{.id = "htg",
                      .extension = "htg",
                      .kind = "octree",
                      .contents = "the octree itself, for the octree methods",
                      .programs = "ParaView",
                      .place = 2};
    exporter.whyNot = [](const CollectedVolume& volume) -> std::string {
        if (volume.isOneOctree()) return {};
        return volume.octrees().empty() ? "provides no octree" : "provides more than one octree";
    };
    exporter.write = [](const ExportedMoment& moment, ExportFolder& folder) {
        const std::string name = fileOf(moment, "htg");
        writeHtg(moment.volume.octrees().front(), moment.origin(), folder.file(name));
        folder.addTo("octree.pvd", Series::Kind::pvd, name, moment);
    };
    return exporter;
}

}  // namespace htg_format

}  // namespace dustbench::exports
