// A shape as its file describes it: data/shapes/car.toml is the manual of its keys.
//
// Units: m, s, linear RGB. Frame: the shape's own; places in the frame that it follows.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/voxel_shape/collision/shape_collision.h"
#include "methods/voxel_shape/particles/motion.h"
#include "methods/voxel_shape/voxels/voxel_change.h"

namespace dustbench::voxel_shape {

enum class Source { vehicle, mesh, grid, voxels };

enum class Voxeliser {
    conservative,  ///< all that the surface touches
    slices,        ///< the paper's, along z
    slicesXyz,     ///< the same along x, y and z, which misses no face for being seen edge-on
};
inline constexpr Choices<Voxeliser> voxelisers{
    {"conservative", Voxeliser::conservative}, {"slices", Voxeliser::slices}, {"slices_xyz", Voxeliser::slicesXyz}};

enum class Fill { surface, solid };
inline constexpr Choices<Fill> fills{{"surface", Fill::surface}, {"solid", Fill::solid}};

/// Whose law it is that holds a shape together.
enum class Mode {
    fixed,  ///< ours: no voxel holds more than its maximum
    paper   ///< maximum density limits births alone, and slices along z are the voxels
};
inline constexpr Choices<Mode> modes{{"fixed", Mode::fixed}, {"paper", Mode::paper}};

/// What a particle is drawn as.
enum class Render { points, lines, sprites, billboards, textured, animated };
inline constexpr Choices<Render> renders{{"points", Render::points},     {"lines", Render::lines},
                                         {"sprites", Render::sprites},   {"billboards", Render::billboards},
                                         {"textured", Render::textured}, {"animated", Render::animated}};

/// The order in which particles are blended.
enum class Order {
    radix,      ///< far to near
    quicksort,  ///< the same, the paper's way
    nearest,    ///< the nearest ones far to near, the others before them as they come
    every,      ///< far to near every few frames, the same order in between
    none,       ///< as they come
};
inline constexpr Choices<Order> orders{{"radix", Order::radix},
                                       {"quicksort", Order::quicksort},
                                       {"nearest", Order::nearest},
                                       {"every", Order::every},
                                       {"none", Order::none}};

struct Look {
    Render render = Render::sprites;
    float pixels = 0;  ///< of points and sprites; 0: as large as the particles are
    bool additive = false;
    bool lit = false;  ///< by the scene's sun and sky
    Order order = Order::radix;
    std::uint32_t nearest = 2000;  ///< so many
    std::uint32_t every = 4;       ///< frames
};

/// A flow from files that draws particles along.
struct FlowField {
    std::vector<std::filesystem::path> files;  ///< empty: none
    std::string field = "velocity";
    float drawsPerSecond = 4;           ///< rate at which particles take on its velocity
    std::optional<double> fromSeconds;  ///< simulated time at which the series begins; empty: that of its files
};

/// Voxels take on a colour where forces push particles away from where they were born.
struct StressLook {
    glm::vec3 colour{0.9f, 0.05f, 0.02f};
    float fullMetres = 0;  ///< displacement at which a voxel shows it wholly; 0: stress is not shown
};

struct TrackKey {
    double timeSeconds = 0;
    glm::dvec3 position{0};
    double heading = 0;
    double scale = 1;
};

/// Where the shape is: in the vehicle's frame, or the world's; at rest with one key, else from key to key, again and
/// again.
struct Track {
    bool followsVehicle = true;
    std::vector<TrackKey> keys;  ///< at least one; times rise from 0
};

struct Shape {
    std::string name;  ///< of the file, for messages
    Source source = Source::vehicle;
    std::filesystem::path mesh;         ///< or the file of voxels
    std::filesystem::path savedVoxels;  ///< where the voxels are written once they are made; empty: nowhere
    glm::vec3 meshColour{0.5f};         ///< where the mesh has none
    float lightFromAbove = 0;           ///< by how much the underside of a mesh is darker than its top, 0..1
    glm::vec3 turn{0};                  ///< of the mesh, radians about x, then z, then y
    float longestSideMetres = 0;        ///< 0: as it is
    glm::ivec3 gridCells{1};
    float gridEdgeMetres = 1;  ///< of a voxel
    int resolution = 50;
    Voxeliser voxeliser = Voxeliser::conservative;
    Fill fill = Fill::surface;
    std::uint32_t particles = 40'000;
    VoxelChange voxels;  ///< of all, whole but for the colour
    std::vector<VoxelEdit> edits;
    Motion motion;
    bool collides = true;  ///< with the scene's solids
    Impact impact;
    float windFactor = 1;  ///< share of the scene's wind
    Look look;
    StressLook stress;
    FlowField flow;
    Track track;
    std::vector<Shape> others;      ///< that are there as well; they have none themselves
    float drawnAlongPerSecond = 4;  ///< rate at which particles in another shape's voxels take on its motion
    float dustDrawsPerSecond =
        0;                  ///< rate at which particles take on the motion of the dust around them; 0: they do not
    double heldWithin = 0;  ///< share by which the particles held may differ from the shape's number; 0: as they like
};

}  // namespace dustbench::voxel_shape
