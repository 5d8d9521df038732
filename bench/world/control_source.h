// Where the controls of each step come from: a drive file, with a driver who follows its target speeds, or a keyboard
// or gamepad; and their recording as a drive file.
//
// Units: SI; controls as in vehicle_dynamics.h: throttle and brake 0..1, steering −1..1 of the vehicle's limit
// (positive: left).
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/world/vehicle_dynamics.h"
#include "methods/kit/files/csv.h"

namespace dustbench::world {

/// Decides the controls of each step.
class ControlSource {
 public:
    virtual ~ControlSource() = default;
    /// Controls for the step that begins at `nowSeconds`; called once per step, in order. The preroll's steps begin
    /// before 0.
    [[nodiscard]] virtual Controls decide(const scene::VehicleParameters& parameters,
                                          const scene::VehicleState& vehicle, double nowSeconds) = 0;
    /// Speed of the vehicle at the start of the preroll.
    [[nodiscard]] virtual double initialSpeed() const { return 0; }
    /// Duration; infinite if it does not end.
    [[nodiscard]] virtual double seconds() const = 0;
    /// A copy that makes the same decisions from now on, used to drive ahead.
    [[nodiscard]] virtual std::unique_ptr<ControlSource> clone() const = 0;
};

/// The driver's input over time, by pedals or by target speed, read from CSV. Columns `time_s,throttle,brake,steer` or
/// `time_s,target_speed_mps,steer`; linear between rows, constant before the first and after the last.
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

/// Follows a target speed with throttle and brake: feed-forward of the required acceleration plus PI control of the
/// error.
class Driver {
 public:
    /// Throttle and brake for a step that starts at target `targetNow` and ends at `targetNext`. `steer` is passed
    /// through. The integral is frozen while the pedals are at their limits (anti-windup).
    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& state,
                                  double targetNow, double targetNext, double steer, double dt);

 private:
    double integral_ = 0;  ///< m/s², added to the wanted acceleration
};

/// Controls from a drive file: its pedal positions, or those of a driver who follows its target speed. The first row's
/// controls apply before its time, the last row's after its time.
class DriveControls final : public ControlSource {
 public:
    explicit DriveControls(Drive drive) : drive_(std::move(drive)) {}

    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& vehicle,
                                  double nowSeconds) override;
    [[nodiscard]] double initialSpeed() const override { return drive_.followsSpeed() ? drive_.targetSpeedAt(0) : 0; }
    [[nodiscard]] double seconds() const override { return drive_.seconds(); }
    [[nodiscard]] std::unique_ptr<ControlSource> clone() const override {
        return std::make_unique<DriveControls>(*this);
    }

 private:
    Drive drive_;
    Driver driver_;
};

/// What keys or the sticks of a gamepad are set to. Keys give 0 or ±1.
struct DrivingInput {
    double throttle = 0, brake = 0, steer = 0;
};

/// Controls of a vehicle that is driven live. It stands until the first step of the drive, whatever keys are pressed: a
/// drive file applies its first row during the preroll, so only then is a recording the same drive. Steering follows
/// the input at a limited rate, so that a key can be tapped. Does not own the input, which the caller changes between
/// steps.
class KeyboardControls final : public ControlSource {
 public:
    static constexpr double steerPerSecond = 3;  ///< the whole range −1..1 is 2

    /// `input` is read at every step; not null.
    explicit KeyboardControls(std::shared_ptr<const DrivingInput> input);

    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& vehicle,
                                  double nowSeconds) override;
    [[nodiscard]] double seconds() const override { return std::numeric_limits<double>::infinity(); }
    [[nodiscard]] std::unique_ptr<ControlSource> clone() const override {
        return std::make_unique<KeyboardControls>(*this);
    }

 private:
    std::shared_ptr<const DrivingInput> input_;
    double steer_ = 0;
};

/// Records the controls of a world's steps and writes them as a drive file. Played back from the same start, the file
/// gives bit-identical controls, and so the same state hash.
class ControlRecording {
 public:
    /// Adds the controls of the next step; the first step begins at time 0.
    void add(const Controls& controls) { steps_.push_back(controls); }
    [[nodiscard]] std::size_t steps() const { return steps_.size(); }
    /// `time_s,throttle,brake,steer`. A drive's pedals apply from the beginning of a step; its steering is the value at
    /// the end of the step. A time that rounds to two values gets two equal rows. Throws std::logic_error if nothing
    /// was recorded.
    [[nodiscard]] std::string csv() const;

 private:
    std::vector<Controls> steps_;
};

}  // namespace dustbench::world
