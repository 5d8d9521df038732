// A shape as described by its file, and the reader of that file. data/shapes/car.toml documents the keys.
//
// Units: m, s, radians, linear RGB. Frame: the shape's own; the track is in the vehicle's frame or the world's.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/voxel_shape/collision/shape_collision.h"
#include "methods/voxel_shape/particles/particle_kernel.h"
#include "methods/voxel_shape/voxels/elastic_load.h"
#include "methods/voxel_shape/voxels/voxel_change.h"

namespace dustbench::voxel_shape {

enum class Source { vehicle, mesh, grid, voxels };

enum class Voxeliser {
    conservative,  ///< every voxel that the surface touches
    slices,        ///< the paper's slices along z
    slicesXyz,     ///< slices along x, y and z: faces that are edge-on to one axis are not missed
};
inline constexpr Choices<Voxeliser> voxelisers{
    {"conservative", Voxeliser::conservative}, {"slices", Voxeliser::slices}, {"slices_xyz", Voxeliser::slicesXyz}};

enum class Fill { surface, solid };
inline constexpr Choices<Fill> fills{{"surface", Fill::surface}, {"solid", Fill::solid}};

/// The rule that limits the number of particles in a voxel.
enum class Mode {
    fixed,  ///< departs from the paper: no voxel holds more than its maximum density
    paper   ///< the paper's: the maximum density limits births only; the voxels are the slices along z
};
inline constexpr Choices<Mode> modes{{"fixed", Mode::fixed}, {"paper", Mode::paper}};

/// The primitive that a particle is drawn as.
enum class Render { points, lines, sprites, billboards, textured, animated };
inline constexpr Choices<Render> renders{{"points", Render::points},     {"lines", Render::lines},
                                         {"sprites", Render::sprites},   {"billboards", Render::billboards},
                                         {"textured", Render::textured}, {"animated", Render::animated}};

/// The order in which particles are blended.
enum class Order {
    radix,      ///< far to near
    quicksort,  ///< far to near by the paper's quicksort
    nearest,    ///< the nearest far to near, drawn after all others, which are unsorted
    every,      ///< far to near every few frames; the order is kept in between
    none,       ///< unsorted
};
inline constexpr Choices<Order> orders{{"radix", Order::radix},
                                       {"quicksort", Order::quicksort},
                                       {"nearest", Order::nearest},
                                       {"every", Order::every},
                                       {"none", Order::none}};

struct Look {
    Render render = Render::sprites;
    float pixels = 0;  ///< diameter of points and sprites; 0: the size of the particles
    bool additive = false;
    bool lit = false;  ///< by the scene's sun and sky
    Order order = Order::radix;
    std::uint32_t nearest = 2000;  ///< particles that Order::nearest sorts
    std::uint32_t every = 4;       ///< interval of Order::every, in frames
};

/// A velocity field read from files that drags particles along.
struct FlowField {
    std::vector<std::filesystem::path> files;  ///< empty: none
    std::string field = "velocity";
    bool followsShape = false;          ///< in the shape's frame, with which it moves; otherwise in the world's
    float drawsPerSecond = 4;           ///< rate at which particles take on its velocity
    std::optional<double> fromSeconds;  ///< simulated time at which the series begins; empty: the time in its files
    float massLoading = 0;              ///< mass of a full voxel's particles by that of its air; 0: no wake
    float wakeSeconds = 2;              ///< time constant with which the wake fades
};

/// Colours voxels by the displacement of their particles from their places of birth.
struct StressLook {
    glm::vec3 colour{0.9f, 0.05f, 0.02f};
    float fullMetres = 0;  ///< displacement at which the colour is fully reached; 0: stress is not shown
};

/// A helix around the axis of a single row of voxels.
struct RowForce {
    float radiansPerSecond = 3;
    float metresPerRadian = 0;
};

struct TrackKey {
    double timeSeconds = 0;
    glm::dvec3 position{0};
    double heading = 0;
    double scale = 1;
};

/// The position of the shape in the vehicle's or the world's frame. One key: at rest. Several keys: from key to key,
/// repeated.
struct Track {
    bool followsVehicle = true;
    std::vector<TrackKey> keys;  ///< at least one; times increase from 0
};

struct Shape {
    std::string name;  ///< file name, for messages
    Source source = Source::vehicle;
    std::filesystem::path mesh;         ///< or the voxel file
    std::filesystem::path savedVoxels;  ///< file to which the finished voxels are written; empty: none
    glm::vec3 meshColour{0.5f};         ///< for meshes without colours
    float lightFromAbove = 0;           ///< how much darker the underside of a mesh is than its top, 0..1
    glm::vec3 turn{0};                  ///< of the mesh: radians about x, then z, then y
    float longestSideMetres = 0;        ///< 0: unscaled
    glm::ivec3 gridCells{1};
    float gridEdgeMetres = 1;  ///< edge of a voxel
    int resolution = 50;
    Voxeliser voxeliser = Voxeliser::conservative;
    Fill fill = Fill::surface;
    std::uint32_t particles = 40'000;
    VoxelChange voxels;  ///< attributes of all voxels; complete except for the colour
    std::vector<VoxelEdit> edits;
    std::optional<RowForce> rowForce;  ///< of voxels in single rows that have no force
    Motion motion;
    Collidable collidesWith;
    Impact impact;
    float windFactor = 1;  ///< share of the scene's wind
    Look look;
    StressLook stress;
    ElasticLoad load;
    FlowField flow;
    Track track;
    std::vector<Shape> others;      ///< further shapes of the scene; they contain no others themselves
    float drawnAlongPerSecond = 4;  ///< rate at which particles in another shape's voxels take on its motion
    float dustDrawsPerSecond = 0;   ///< rate at which particles take on the motion of the dust around them; 0: none
    double heldWithin = 0;  ///< allowed relative deviation of the particles held from the shape's number; 0: unchecked
};

/// Reads a shape from TOML. Throws InputError with file, line, the value read and the expected values.
[[nodiscard]] Shape readShape(const std::filesystem::path& file);
/// Reads an edit of the shape file `from`. Looks for its mesh next to that file, then in the data folder.
[[nodiscard]] VoxelEdit readEdit(files::TomlReader& table, const std::filesystem::path& from);

}  // namespace dustbench::voxel_shape
