#include "bench/scene/drive.h"

#include <algorithm>

#include "methods/contract/errors.h"

namespace dustbench::bench {
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

}  // namespace dustbench::bench
