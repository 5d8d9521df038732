// Facts: values that a method reports in addition to times, memory and pictures. A method declares each once, with its
// unit and meaning.
//
// Each declared fact becomes a column of summary.csv, a row of `dustbench list metrics` and a row of reports/SCHEMA.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dustbench {

/// Which value of a fact is kept: the maximum over all recorded frames, or the value after the last one.
enum class FactOver { maximumOfFrames, lastFrame };

/// A run with a fact outside of this range is reported, and claims ignore it: the method did not do what was asked.
struct ValidRange {
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool contains(double value) const { return minimum <= value && value <= maximum; }
    bool operator==(const ValidRange&) const = default;
};

struct FactInfo {
    std::string name;  ///< lower case, `mass_kept`; methods that declare the same name give it the same meaning
    std::string unit;  ///< `m/s`, `particles`, `share`
    FactOver over = FactOver::lastFrame;
    std::string meaning;  ///< one line
    ValidRange valid{};   ///< any value, if not declared

    bool operator==(const FactInfo&) const = default;
};

using FactValue = std::variant<std::int64_t, double>;

/// Collects the facts reported in one call of `Method::report`.
class DUSTBENCH_API Facts {
 public:
    /// Accepts the facts in `declared` whose FactInfo::over equals `over`. `declared` must outlive this object.
    Facts(const std::vector<FactInfo>& declared, FactOver over);

    /// False if the fact would be discarded, so that a method can skip computing it.
    [[nodiscard]] bool wants(std::string_view name) const;
    /// Throws std::logic_error for an undeclared name. Discards facts that are not wanted.
    void set(std::string_view name, FactValue value);

    /// Clears all values.
    void clear();

    /// Empty if the method did not report the fact.
    [[nodiscard]] std::optional<FactValue> value(std::string_view name) const;

 private:
    struct Entry {
        const FactInfo* info;
        std::optional<FactValue> value;
    };
    [[nodiscard]] std::size_t indexOf(std::string_view name) const;

    std::vector<Entry> entries_;
    FactOver over_;
};

}  // namespace dustbench
