#include "bench/world/control_source.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "bench/world/time_step.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"

namespace dustbench::world {
namespace {

/// Maximum target speed in a drive; catches values given in km/h or mm/s.
constexpr double fastestTarget = 100;

const std::vector<std::string> pedalColumns{"time_s", "throttle", "brake", "steer"};
const std::vector<std::string> speedColumns{"time_s", "target_speed_mps", "steer"};

double ranged(const files::CsvTable& table, std::size_t row, const std::string& column, double minimum,
              double maximum) {
    const double value = table.number(row, column);
    if (value < minimum || value > maximum)
        throw InputError(table.where(row) + "column '" + column + "': got " + files::csvNumber(value) +
                         ", expected a number " + files::csvNumber(minimum) + ".." + files::csvNumber(maximum));
    return value;
}

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

constexpr double proportionalPerSecond = 1.5;
constexpr double integralPerSquareSecond = 0.3;
/// Below this speed, with a target of 0, the driver brakes to a halt and holds the car.
constexpr double haltSpeed = 0.3;
constexpr double haltBrake = 0.3;

/// The times at which a drive is evaluated: k·Δt for the pedals of the step that begins there, and (k−1)·Δt + Δt for
/// the steering of the step that ends there. Rounded, they may differ, and between two rows values are interpolated.
std::set<double> timesOf(std::size_t row) {
    const auto k = static_cast<double>(row);
    return row == 0 ? std::set{0.0} : std::set{k * stepSeconds, (k - 1) * stepSeconds + stepSeconds};
}

}  // namespace

Drive Drive::parseFile(const std::filesystem::path& file) {
    return fromTable(files::CsvTable::parseFile(file), file.string());
}

Drive Drive::parseText(std::string_view text, const std::string& name) {
    const files::CsvTable table = files::CsvTable::parseText(text, name);
    return fromTable(table, name);
}

Drive Drive::fromTable(const files::CsvTable& table, const std::string& name) {
    std::vector<std::string> columns = table.header();
    std::ranges::sort(columns);
    const auto has = [&](std::vector<std::string> wanted) {
        std::ranges::sort(wanted);
        return columns == wanted;
    };
    const bool bySpeed = has(speedColumns);
    if (!bySpeed && !has(pedalColumns))
        throw InputError(name + ":1: got the columns " + join(table.header()) + ", expected " + join(pedalColumns) +
                         " or " + join(speedColumns));
    if (table.rows() == 0) throw InputError(name + ":2: the drive has no rows, expected one or more");

    Drive drive;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double time = ranged(table, row, "time_s", 0, 1e6);
        if (row == 0 && time != 0)
            throw InputError(table.where(row) + "column 'time_s': got " + table.cell(row, "time_s") +
                             ", expected 0 in the first row");
        if (row > 0 && time <= drive.times_.back())
            throw InputError(table.where(row) + "column 'time_s': got " + table.cell(row, "time_s") +
                             ", expected more than " + files::csvNumber(drive.times_.back()) + " (previous row)");
        drive.times_.push_back(time);
        drive.steers_.push_back(ranged(table, row, "steer", -1, 1));
        if (bySpeed) {
            drive.speeds_.push_back(ranged(table, row, "target_speed_mps", 0, fastestTarget));
        } else {
            drive.throttles_.push_back(ranged(table, row, "throttle", 0, 1));
            drive.brakes_.push_back(ranged(table, row, "brake", 0, 1));
        }
    }
    return drive;
}

double Drive::at(const std::vector<double>& values, double timeSeconds) const {
    const auto after = std::ranges::upper_bound(times_, timeSeconds);
    if (after == times_.begin()) return values.front();
    if (after == times_.end()) return values.back();
    const auto i = static_cast<std::size_t>(after - times_.begin());
    const double share = (timeSeconds - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
}

void Drive::replaceSpeeds(double speed) {
    for (double& target : speeds_)
        if (target > 0) target = speed;
}

Controls Driver::decide(const scene::VehicleParameters& parameters, const scene::VehicleState& state, double targetNow,
                        double targetNext, double steer, double dt) {
    if (targetNow <= 0 && targetNext <= 0 && state.speed < haltSpeed) {
        integral_ = 0;
        return {0, haltBrake, steer};
    }
    const double error = targetNow - state.speed;
    // a = dv*/dt + resistance + g·slope + k_p e + ∫ k_i e dt
    const double wanted = (targetNext - targetNow) / dt + resistanceDeceleration(parameters, state.speed) +
                          gravity * state.forward().y + proportionalPerSecond * error + integral_;
    const double maximum = fullThrottleAcceleration(parameters, state.speed);
    const double minimum = -parameters.brakeDecelerationLimit;
    const bool atStop = (wanted >= maximum && error > 0) || (wanted <= minimum && error < 0);
    if (!atStop) integral_ += integralPerSquareSecond * error * dt;
    return {std::clamp(wanted / maximum, 0.0, 1.0), std::clamp(wanted / minimum, 0.0, 1.0), steer};
}

Controls DriveControls::decide(const scene::VehicleParameters& parameters, const scene::VehicleState& vehicle,
                               double nowSeconds) {
    const double next = nowSeconds + stepSeconds;
    const double steer = drive_.steerAt(next);
    if (!drive_.followsSpeed()) return {drive_.throttleAt(nowSeconds), drive_.brakeAt(nowSeconds), steer};
    return driver_.decide(parameters, vehicle, drive_.targetSpeedAt(nowSeconds), drive_.targetSpeedAt(next), steer,
                          stepSeconds);
}

KeyboardControls::KeyboardControls(std::shared_ptr<const DrivingInput> input) : input_(std::move(input)) {
    if (!input_) throw std::invalid_argument("KeyboardControls: no input");
}

Controls KeyboardControls::decide(const scene::VehicleParameters&, const scene::VehicleState&, double nowSeconds) {
    if (nowSeconds < 0.5 * stepSeconds) return {};
    const double wanted = std::clamp(input_->steer, -1.0, 1.0);
    constexpr double limit = steerPerSecond * stepSeconds;
    steer_ += std::clamp(wanted - steer_, -limit, limit);
    return {std::clamp(input_->throttle, 0.0, 1.0), std::clamp(input_->brake, 0.0, 1.0), steer_};
}

std::string ControlRecording::csv() const {
    if (steps_.empty()) throw std::logic_error("ControlRecording: no steps");
    std::string text = "time_s,throttle,brake,steer\n";
    for (std::size_t row = 0; row <= steps_.size(); ++row) {
        const Controls& begins = steps_[row < steps_.size() ? row : row - 1];
        const Controls& ends = steps_[row > 0 ? row - 1 : 0];
        for (const double time : timesOf(row)) {
            for (const double value : {time, begins.throttle, begins.brake}) text += files::csvNumber(value) + ",";
            text += files::csvNumber(ends.steer) + "\n";
        }
    }
    return text;
}

}  // namespace dustbench::world
