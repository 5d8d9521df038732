#include "methods/kit/volumes/openvdb/test_grids.h"

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <glm/gtc/type_ptr.hpp>

namespace dustbench::volumes {

struct AnyTestGrid::Held {
    openvdb::GridBase::Ptr grid;
};

namespace {

template <typename Value>
Value toVdb(const Value& value) {
    return value;
}
openvdb::Vec3s toVdb(const glm::vec3& value) {
    return {value.x, value.y, value.z};
}
openvdb::Coord toVdb(const glm::ivec3& cell) {
    return {cell.x, cell.y, cell.z};
}

template <typename Value>
using GridOf = typename openvdb::FloatGrid::ValueConverter<decltype(toVdb(Value()))>::Type;

template <typename Value>
GridOf<Value>& typed(const TestGrid<Value>& grid) {
    return static_cast<GridOf<Value>&>(*grid.held().grid);
}

std::shared_ptr<AnyTestGrid::Held> hold(openvdb::GridBase::Ptr grid) {
    return std::make_shared<AnyTestGrid::Held>(AnyTestGrid::Held{std::move(grid)});
}

}  // namespace

void AnyTestGrid::setName(const std::string& name) {
    held_->grid->setName(name);
}

void AnyTestGrid::setClass(const std::string& gridClass) {
    held_->grid->setGridClass(openvdb::GridBase::stringToGridClass(gridClass));
}

void AnyTestGrid::setTime(float seconds) {
    held_->grid->insertMeta("time_s", openvdb::FloatMetadata(seconds));
}

void AnyTestGrid::setTime(double seconds) {
    held_->grid->insertMeta("time_s", openvdb::DoubleMetadata(seconds));
}

void AnyTestGrid::setSavedAsHalf(bool isSavedAsHalf) {
    held_->grid->setSaveFloatAsHalf(isSavedAsHalf);
}

void AnyTestGrid::setCellSize(double size) {
    held_->grid->setTransform(openvdb::math::Transform::createLinearTransform(size));
}

void AnyTestGrid::setTransform(const glm::dmat4& worldOfCells) {
    // OpenVDB's rows are GLM's columns: it multiplies rows by matrices.
    const openvdb::Mat4d matrix(glm::value_ptr(worldOfCells));
    held_->grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
}

void AnyTestGrid::translate(const glm::dvec3& by) {
    held_->grid->transform().postTranslate({by.x, by.y, by.z});
}

void AnyTestGrid::clear() {
    held_->grid->clear();
}

glm::ivec3 AnyTestGrid::firstCell() const {
    const openvdb::Coord first = held_->grid->evalActiveVoxelBoundingBox().min();
    return {first.x(), first.y(), first.z()};
}

template <typename Value>
TestGrid<Value>::TestGrid(const Value& background) : AnyTestGrid(hold(nullptr)) {
    openvdb::initialize();
    // GridOf<Value>::create would compile all virtual functions of the class again.
    held().grid = openvdb::GridBase::createGrid(GridOf<Value>::gridType());
    typed(*this).tree().root().setBackground(toVdb(background), /*updateChildNodes=*/false);
}

template <typename Value>
void TestGrid<Value>::set(const glm::ivec3& cell, const Value& value) {
    typed(*this).tree().setValue(toVdb(cell), toVdb(value));
}

template <typename Value>
void TestGrid<Value>::switchOff(const glm::ivec3& cell) {
    typed(*this).tree().setValueOff(toVdb(cell));
}

template <typename Value>
void TestGrid<Value>::fill(const glm::ivec3& first, const glm::ivec3& last, const Value& value) {
    typed(*this).tree().denseFill({toVdb(first), toVdb(last)}, toVdb(value), /*active=*/true);
}

template <typename Value>
void TestGrid<Value>::changeBackground(const Value& value) {
    openvdb::tools::changeBackground(typed(*this).tree(), toVdb(value));
}

template <typename Value>
TestGrid<Value> TestGrid<Value>::deepCopy() const {
    return TestGrid(hold(typed(*this).deepCopyGrid()));
}

template <typename Value>
Value TestGrid<Value>::valueAt(const glm::dvec3& place) const {
    const openvdb::Vec3d index = typed(*this).worldToIndex({place.x, place.y, place.z});
    return typed(*this).tree().getValue(openvdb::Coord::round(index));
}

template <typename Value>
double TestGrid<Value>::sumOfActive() const {
    double sum = 0;
    for (auto value = typed(*this).cbeginValueOn(); value; ++value)
        sum += static_cast<double>(*value) * static_cast<double>(value.getVoxelCount());
    return sum;
}

template class TestGrid<float>;
template TestGrid<int>::TestGrid(const int&);
template void TestGrid<int>::set(const glm::ivec3&, const int&);
template TestGrid<glm::vec3>::TestGrid(const glm::vec3&);
template void TestGrid<glm::vec3>::set(const glm::ivec3&, const glm::vec3&);
template void TestGrid<glm::vec3>::fill(const glm::ivec3&, const glm::ivec3&, const glm::vec3&);

TestGrid<float> levelSetSphere(float radius, const glm::vec3& centre, float cellSize) {
    openvdb::initialize();
    return TestGrid<float>(
        hold(openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(radius, toVdb(centre), cellSize)));
}

void makeFog(TestGrid<float>& distance) {
    openvdb::tools::sdfToFogVolume(typed(distance));
}

AnyTestGrid pointsGrid(const std::vector<glm::vec3>& places, const std::vector<float>& radii,
                       const std::vector<int>& ids, double cellSize) {
    openvdb::initialize();
    using namespace openvdb::points;
    std::vector<openvdb::Vec3f> positions;
    positions.reserve(places.size());
    for (const glm::vec3& place : places) positions.push_back(toVdb(place));
    const PointAttributeVector<openvdb::Vec3f> wrapper(positions);
    const auto transform = openvdb::math::Transform::createLinearTransform(cellSize);
    const auto index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(wrapper, *transform);
    const auto grid = createPointDataGrid<NullCodec, PointDataGrid>(*index, wrapper, *transform);
    appendAttribute<float>(grid->tree(), "pscale");
    appendAttribute<int>(grid->tree(), "id");
    appendGroup(grid->tree(), "some");
    const PointAttributeVector<float> radiusWrapper(radii);
    const PointAttributeVector<int> idWrapper(ids);
    populateAttribute(grid->tree(), index->tree(), "pscale", radiusWrapper);
    populateAttribute(grid->tree(), index->tree(), "id", idWrapper);
    return AnyTestGrid(hold(grid));
}

void writeVdb(const std::filesystem::path& file, const std::vector<AnyTestGrid>& grids, bool isZipped) {
    openvdb::GridPtrVec written;
    for (const AnyTestGrid& each : grids) written.push_back(each.held().grid);
    openvdb::io::File vdb(file);
    if (isZipped) vdb.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    vdb.write(written);
}

void writeNanoVdb(const std::filesystem::path& file, const std::vector<AnyTestGrid>& grids) {
    std::vector<nanovdb::GridHandle<nanovdb::HostBuffer>> handles;
    for (const AnyTestGrid& each : grids)
        if (const auto numbers = openvdb::gridPtrCast<openvdb::FloatGrid>(each.held().grid))
            handles.push_back(nanovdb::OpenToNanoVDB<float, float>()(*numbers));
        else
            handles.push_back(nanovdb::OpenToNanoVDB<openvdb::Vec3f, nanovdb::Vec3f>()(
                *openvdb::gridPtrCast<openvdb::Vec3SGrid>(each.held().grid)));
    nanovdb::io::writeGrids(file, handles);
}

}  // namespace dustbench::volumes
