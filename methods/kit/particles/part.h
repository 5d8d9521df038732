// A part: one thing that a particle system does, of one of nine kinds; made by name, with parameters declared once.
//
// A new part is one file, parts/KIND/NAME.cpp, with a function `PartInfo describe()` in the namespace
// dustbench::particles::parts::KIND::NAME; the table is generated from the files. A new kind is a header beside this
// one. Source: Thesis, 3.1.3 (the plugins).
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "methods/contract/parameters.h"

namespace dustbench::particles {

/// The first six are single in a system; of the last three there are lists.
enum class PartKind { emission, position, velocity, colour, size, render, life, shading, force };

/// As they are called in files.
inline constexpr std::array<std::string_view, 9> partKindNames{"emission", "position", "velocity", "colour", "size",
                                                               "render",   "life",     "shading",  "force"};

[[nodiscard]] constexpr std::string_view kindName(PartKind kind) {
    return partKindNames[static_cast<std::size_t>(kind)];
}
[[nodiscard]] constexpr bool isList(PartKind kind) {
    return kind >= PartKind::life;
}

class DUSTBENCH_API Part {
 public:
    explicit Part(ParameterValues values) : values_(std::move(values)) {}
    virtual ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

    [[nodiscard]] virtual PartKind kind() const = 0;
    [[nodiscard]] const std::string& name() const { return name_; }
    /// For the table: a part has the name of its file.
    void setName(std::string name) { name_ = std::move(name); }
    [[nodiscard]] const ParameterValues& values() const { return values_; }

 private:
    std::string name_;
    ParameterValues values_;
};

/// What the table knows of a part before there is one. Kind and name are those of its folder and file.
struct PartInfo {
    PartKind kind{};
    std::string name{};
    std::string help{};    ///< one line
    std::string source{};  ///< key in data/references.bib with section, or empty
    ParameterSet parameters{};
    /// Throws InputError where values that are each allowed do not go together.
    std::function<std::unique_ptr<Part>(const ParameterValues&)> create{};
};

}  // namespace dustbench::particles
