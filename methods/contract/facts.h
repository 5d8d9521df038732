// What a method can tell of a run besides times, memory and pictures: facts that it declares once, with unit and
// meaning.
//
// A declared fact is a column of summary.csv, a row of `dustbench list metrics` and a row of reports/SCHEMA.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dustbench {

/// Of which moments a fact is kept: the maximum of all recorded frames, or the value after the last one.
enum class FactOver { maximumOfFrames, lastFrame };

struct FactInfo {
    std::string name;  ///< lower case, `mass_kept`; methods that declare the same name mean the same
    std::string unit;  ///< `m/s`, `particles`, `share`
    FactOver over = FactOver::lastFrame;
    std::string meaning;  ///< one line

    bool operator==(const FactInfo&) const = default;
};

using FactValue = std::variant<std::int64_t, double>;

/// Collects what a method tells in one call of `Method::report`.
class DUSTBENCH_API Facts {
 public:
    /// Asks for those of `declared` (which must outlive this) that are kept `over` such moments.
    Facts(const std::vector<FactInfo>& declared, FactOver over);

    /// False for a fact that would be thrown away: a method need not work it out.
    [[nodiscard]] bool wants(std::string_view name) const;
    /// Throws std::logic_error for a name that was not declared. A fact that nobody wants is dropped.
    void tell(std::string_view name, FactValue value);

    /// Forgets all that was told.
    void clear();

    /// Empty where the method did not tell it.
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
