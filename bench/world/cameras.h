// The cameras of a scene: fixed, chasing the vehicle, orbiting it, next to a wheel, or on a key-framed path. All but
// the path's files are pure functions of state and time.
//
// Units: SI, radians. Frame: world, or the vehicle's heading frame (+X forward, +Y up, +Z right) where stated.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/contract/view.h"

namespace dustbench::world {

enum class CameraKind { chase, fixed, orbit, wheel };
inline constexpr Choices<CameraKind> cameraKinds{{"chase", CameraKind::chase},
                                                 {"fixed", CameraKind::fixed},
                                                 {"orbit", CameraKind::orbit},
                                                 {"wheel", CameraKind::wheel}};

struct FixedCamera {
    glm::dvec3 eye{30, 4, 24};
    glm::dvec3 target{0, 1, 0};
    double verticalFieldOfView = 0.9;
};

/// Follows the vehicle's smoothed heading and height; looks at the area behind it, where the dust is.
struct ChaseCamera {
    glm::dvec3 offset{6.8, 2.5, 9.4};
    glm::dvec3 lookAt{-4.2, 1.2, 0};
    double smoothingSeconds = 0.5;
    double verticalFieldOfView = 0.9;
};

struct OrbitCamera {
    double radiusMetres = 18;
    double heightMetres = 5;
    double turnRate = 0.25;   ///< rad/s, counter-clockwise seen from above
    double startAngle = 0.7;  ///< at time 0, from the world's +X
    glm::dvec3 lookAt{-3, 0.8, 0};
    double verticalFieldOfView = 0.9;
};

/// Moves with the vehicle, without smoothing, and looks at the dust that a rear wheel raises.
struct WheelCamera {
    glm::dvec3 offset{0.8, 0.55, 2.9};
    glm::dvec3 lookAt{-1.6, 0.4, 0.6};
    double verticalFieldOfView = 0.9;
};

struct CameraSet {
    FixedCamera fixed;
    ChaseCamera chase;
    OrbitCamera orbit;
    WheelCamera wheel;
};

/// The vehicle's heading and height as seen by the chase camera: a first-order lag behind the true ones.
struct CameraLag {
    double heading = 0;
    double height = 0;

    /// No lag: at the vehicle's heading and height.
    [[nodiscard]] static CameraLag at(const scene::VehicleState& vehicle);
    /// The lag `dt` seconds later, with the vehicle held at the given state.
    [[nodiscard]] CameraLag followed(const scene::VehicleState& vehicle, double lagSeconds, double dt) const;
};

[[nodiscard]] scene::Camera cameraAt(CameraKind kind, const CameraSet& cameras, const scene::SceneState& state,
                                     const CameraLag& lag, const scene::Terrain& terrain);

/// A key of a camera path. In degrees, as in the file, so that a path written and read again is the same.
struct CameraKey {
    double seconds = 0;
    glm::dvec3 eye{0, 2, 10};
    glm::dvec3 target{0, 1, 0};
    double fieldOfViewDegrees = 51.5;  ///< vertical

    friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

/// Eye, target and field of view over time, from the start of the drive: a piecewise cubic through the keys with
/// continuous velocity, constant before the first key and after the last. One key gives a fixed camera.
class CameraPath {
 public:
    /// A CSV table with the columns `time_s,eye_x,eye_y,eye_z,target_x,target_y,target_z,fov_deg`. Throws InputError
    /// with file, line and what was expected.
    static CameraPath parseFile(const std::filesystem::path& file);
    static CameraPath parseText(std::string_view csv, const std::string& name);
    /// A .csv file, or the rows themselves on one line, separated by ';'.
    static CameraPath read(const std::string& fileOrRows);

    /// One or more keys, by ascending time; throws std::invalid_argument otherwise.
    explicit CameraPath(std::vector<CameraKey> keys);

    [[nodiscard]] const std::vector<CameraKey>& keys() const { return keys_; }
    [[nodiscard]] scene::Camera at(double seconds) const;

    [[nodiscard]] std::string csv() const;
    /// The rows on one line, as read() accepts them.
    [[nodiscard]] std::string rows() const;

 private:
    std::vector<CameraKey> keys_;
};

/// True if read() treats this text as a file.
[[nodiscard]] bool isCameraFile(std::string_view fileOrRows);

}  // namespace dustbench::world
