// A drive: the driver's input over time, by pedals or by target speed, read from CSV.
//
// Units: s, m/s; throttle and brake 0..1, steering −1..1 of the vehicle's limit (positive: left).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/files/csv.h"

namespace dustbench::bench {

/// Columns `time_s,throttle,brake,steer` or `time_s,target_speed_mps,steer`; linear between rows, constant before the
/// first and after the last.
class Drive {
 public:
    /// Throws InputError with file, line and what was expected.
    static Drive parseFile(const std::filesystem::path& file);
    static Drive parseText(std::string_view text, const std::string& name);

    [[nodiscard]] bool followsSpeed() const { return !speeds_.empty(); }
    /// Time of the last row.
    [[nodiscard]] double seconds() const { return times_.back(); }

    [[nodiscard]] double steerAt(double timeSeconds) const { return at(steers_, timeSeconds); }
    [[nodiscard]] double targetSpeedAt(double timeSeconds) const { return at(speeds_, timeSeconds); }
    [[nodiscard]] double throttleAt(double timeSeconds) const { return at(throttles_, timeSeconds); }
    [[nodiscard]] double brakeAt(double timeSeconds) const { return at(brakes_, timeSeconds); }

    /// Replaces every target speed above 0 by `speed`.
    void replaceSpeeds(double speed);

 private:
    static Drive fromTable(const files::CsvTable& table, const std::string& name);
    [[nodiscard]] double at(const std::vector<double>& values, double timeSeconds) const;

    std::vector<double> times_, steers_;
    std::vector<double> speeds_;              ///< for drives by target speed
    std::vector<double> throttles_, brakes_;  ///< for drives by pedals
};

}  // namespace dustbench::bench
