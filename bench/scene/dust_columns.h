// Which columns of a file mean what: positions, radius, opacity … of particles that another program wrote.
//
// A setting is `key=NAME`, a column; `key=A+B+C`, three columns for a vector; or `key=0.5`, one number for all.
// Without a setting the usual names are tried (reports/guide/own-data.md lists them).
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/volumes/point_table.h"

namespace dustbench::bench {

/// The numbers of one quantity: of one column each, or one for all.
struct ColumnNumbers {
    struct Part {
        const std::vector<double>* values = nullptr;  ///< null: `constant`
        std::size_t stride = 1, first = 0;
        double constant = 0;
        bool isByte = false;  ///< as PointColumn's
    };
    std::string name;  ///< for messages
    std::vector<Part> parts;

    [[nodiscard]] double at(std::size_t point, std::size_t part = 0) const {
        const Part& p = parts[part];
        return p.values ? (*p.values)[point * p.stride + p.first] : p.constant;
    }
};

class DustColumns {
 public:
    /// `position=Points,radius=R`, or a `.toml` file with the same keys; empty: the usual names. Throws InputError.
    static DustColumns parse(const std::string& textOrFile);

    [[nodiscard]] bool wants(std::string_view column) const;
    /// Empty if the table has no such quantity. Throws InputError, with `file`, if a column that was named is missing
    /// or has another number of components.
    [[nodiscard]] std::optional<ColumnNumbers> find(const volumes::PointTable& table, std::string_view key,
                                                    const std::string& file) const;
    /// +Z is up in the file.
    [[nodiscard]] bool zUp() const { return zUp_; }
    /// Metres of one unit of length in the file.
    [[nodiscard]] double metresPerUnit() const { return metresPerUnit_; }

 private:
    void set(const std::string& key, const std::string& value);

    std::map<std::string, std::string, std::less<>> given_;
    bool zUp_ = false;
    double metresPerUnit_ = 1;
};

}  // namespace dustbench::bench
