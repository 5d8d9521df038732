// For tests: grids made by OpenVDB, and the files that it and NanoVDB write. Their headers are slow to compile, so only
// test_grids.cpp includes them.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace dustbench::volumes {

/// A grid of OpenVDB. Copies share it.
class AnyTestGrid {
 public:
    struct Held;
    explicit AnyTestGrid(std::shared_ptr<Held> held) : held_(std::move(held)) {}

    void setName(const std::string& name);
    /// The class by its name in OpenVDB: "fog volume", "staggered", "unknown" …
    void setClass(const std::string& gridClass);
    /// The metadata have the type of the argument.
    void setTime(float seconds);
    void setTime(double seconds);
    void setSavedAsHalf(bool isSavedAsHalf);
    void setCellSize(double size);
    void setTransform(const glm::dmat4& worldOfCells);
    void translate(const glm::dvec3& by);
    void clear();
    /// The minimum corner of the box of active cells.
    [[nodiscard]] glm::ivec3 firstCell() const;
    [[nodiscard]] Held& held() const { return *held_; }

 private:
    std::shared_ptr<Held> held_;
};

/// `Value` is float, int or glm::vec3; test_grids.cpp instantiates what the tests use.
template <typename Value>
class TestGrid : public AnyTestGrid {
 public:
    using AnyTestGrid::AnyTestGrid;
    explicit TestGrid(const Value& background = Value());
    explicit TestGrid(const std::string& name, const Value& background = Value()) : TestGrid(background) {
        setName(name);
    }

    void set(const glm::ivec3& cell, const Value& value);
    /// The cell keeps its value.
    void switchOff(const glm::ivec3& cell);
    /// Sets every cell from `first` to `last`. Each is stored, even if a tile of OpenVDB could stand for many.
    void fill(const glm::ivec3& first, const glm::ivec3& last, const Value& value);
    void changeBackground(const Value& value);
    [[nodiscard]] TestGrid deepCopy() const;
    /// The value of the cell around a place in the world.
    [[nodiscard]] Value valueAt(const glm::dvec3& place) const;
    [[nodiscard]] double sumOfActive() const;
};

/// The distance to the surface of a sphere.
TestGrid<float> levelSetSphere(float radius, const glm::vec3& centre, float cellSize);
/// Makes fog of such a distance, as OpenVDB's sdfToFogVolume.
void makeFog(TestGrid<float>& distance);

/// Points with radii as `pscale`, numbers as `id`, and a group of points, `some`.
AnyTestGrid pointsGrid(const std::vector<glm::vec3>& places, const std::vector<float>& radii,
                       const std::vector<int>& ids, double cellSize);

/// Compressed as OpenVDB does by default, or zipped.
void writeVdb(const std::filesystem::path& file, const std::vector<AnyTestGrid>& grids, bool isZipped = false);
/// The grids have floats or vectors.
void writeNanoVdb(const std::filesystem::path& file, const std::vector<AnyTestGrid>& grids);

}  // namespace dustbench::volumes
