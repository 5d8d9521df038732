// A part: one aspect of a particle system, of one of ten kinds; created by name, with declared parameters. The table of
// all parts that a particle system's file can use.
//
// A new part is one file, parts/KIND/NAME.cpp, with a function `PartInfo describe()` in the namespace
// dustbench::particles::parts::KIND::NAME; the table is generated from the files. A new kind is a class in
// part_kinds.h or a header next to it. Source: Thesis, 3.1.3 (the plugins). Departs: the kind event is ours.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/contract/parameters.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles {

/// A system has one part of each of the first six kinds, and a list of each of the last four.
enum class PartKind { emission, position, velocity, colour, size, render, life, shading, force, event };

/// Names of the kinds in files.
inline constexpr std::array<std::string_view, 10> partKindNames{"emission", "position", "velocity", "colour", "size",
                                                                "render",   "life",     "shading",  "force",  "event"};

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
    /// Called by the table: a part is named after its file.
    void setName(std::string name) { name_ = std::move(name); }
    [[nodiscard]] const ParameterValues& values() const { return values_; }

    /// True: the part works only with a position that is a lattice (PositionPart::lattice).
    [[nodiscard]] virtual bool needsLattice() const { return false; }

    /// What the part looks like; empty: it is not drawn.
    [[nodiscard]] virtual std::optional<Mark> mark() const { return std::nullopt; }

    /// Continues from `before`, which this part replaces in a running system. A part whose state persists between steps
    /// (an accumulator) copies the state of a part of the same class.
    virtual void takeOver(const Part& /*before*/) {}

 private:
    std::string name_;
    ParameterValues values_;
};

/// Static description of a part. Kind and name come from its folder and file.
struct PartInfo {
    PartKind kind{};
    std::string name{};
    std::string help{};    ///< one line
    std::string source{};  ///< key in data/references.bib with section, or empty
    ParameterSet parameters{};
    /// Throws InputError if values that are allowed individually are inconsistent.
    std::function<std::unique_ptr<Part>(const ParameterValues&)> create{};
    std::string library{};  ///< the file it was loaded from; empty for parts of this build; set by the table
};

/// The table: all parts, ordered by kind and name.
[[nodiscard]] DUSTBENCH_API const std::vector<PartInfo>& partTable();

/// Throws InputError if a part of this kind and name exists.
DUSTBENCH_API void requireNewPart(const PartInfo& info);
/// Adds a part from a library, with `library` set. References into partTable() become invalid. Throws as above.
DUSTBENCH_API void addPart(PartInfo info);

/// Notes the part's library as an input of the run. Throws InputError, which suggests the nearest name.
[[nodiscard]] DUSTBENCH_API const PartInfo& findPart(PartKind kind, std::string_view name);

using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// A part with default parameters, except for the given values. Throws InputError with the values allowed.
[[nodiscard]] DUSTBENCH_API std::unique_ptr<Part> makePart(PartKind kind, std::string_view name,
                                                           const NamedValues& values = {});

/// The same with the class of its kind, for callers that use the part directly.
template <typename Kind>
[[nodiscard]] std::unique_ptr<Kind> makePartOf(PartKind kind, std::string_view name, const NamedValues& values = {}) {
    std::unique_ptr<Part> part = makePart(kind, name, values);
    return std::unique_ptr<Kind>(&dynamic_cast<Kind&>(*part.release()));
}

}  // namespace dustbench::particles
