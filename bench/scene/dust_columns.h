// Maps the columns of a particle file from another program to quantities: positions, radius, opacity …
//
// A setting is `key=NAME` for a column, `key=A+B+C` for the three columns of a vector, or `key=0.5` for one number for
// all particles. Without a setting, the usual names are tried (reports/guide/own-data.md lists them).
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

/// The numbers of one quantity: a column for each component, or one number for all.
struct ColumnNumbers {
    struct Part {
        const std::vector<double>* values = nullptr;  ///< null: `constant`
        std::size_t stride = 1, first = 0;
        double constant = 0;
        bool isByte = false;  ///< as in PointColumn
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
    /// Empty if the table does not contain the quantity. Throws InputError, with `file`, if a named column is missing
    /// or has another number of components.
    [[nodiscard]] std::optional<ColumnNumbers> find(const volumes::PointTable& table, std::string_view key,
                                                    const std::string& file) const;
    /// True if +Z is up in the file.
    [[nodiscard]] bool zUp() const { return zUp_; }
    /// Metres per unit of length of the file.
    [[nodiscard]] double metresPerUnit() const { return metresPerUnit_; }

 private:
    void set(const std::string& key, const std::string& value);

    std::map<std::string, std::string, std::less<>> given_;
    bool zUp_ = false;
    double metresPerUnit_ = 1;
};

}  // namespace dustbench::bench
