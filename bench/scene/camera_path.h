// A key-framed camera path: eye, target and field of view over time.
//
// A piecewise cubic through the keys with continuous velocity; constant before the first key and after the last. One
// key gives a fixed camera.
// Units: s, m; the field of view in degrees, as in the file, so that a path written and read again is the same.
// Frame: world. Time 0 is the start of the drive.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/view.h"

namespace dustbench::bench {

struct CameraKey {
    double seconds = 0;
    glm::dvec3 eye{0, 2, 10};
    glm::dvec3 target{0, 1, 0};
    double fieldOfViewDegrees = 51.5;  ///< vertical

    friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

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

}  // namespace dustbench::bench
