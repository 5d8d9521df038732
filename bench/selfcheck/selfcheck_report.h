// The findings of a self-check about this machine, and selfcheck.json, which they are written to and read from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/measure/provenance.h"
#include "methods/contract/choices.h"

namespace dustbench::selfcheck {

/// attention: the program works around it, but results mean less. failed: results of this machine are wrong.
enum class Outcome { ok, attention, failed };
inline constexpr Choices<Outcome> outcomes{
    {"ok", Outcome::ok}, {"attention", Outcome::attention}, {"failed", Outcome::failed}};

/// What was measured, what is expected, and whether it is right.
struct Check {
    std::string name;
    Outcome outcome = Outcome::ok;
    std::string measured;
    std::string expected;  ///< empty for a plain fact
    std::string note{};    ///< what it means for results; empty where the outcome says enough
};

/// An object with `passed`, `device`, `machine`, `program` and `checks`: `{name, outcome, measured, expected, note}`.
[[nodiscard]] std::string selfcheckJson(const measure::Provenance& provenance, const std::vector<Check>& checks);

/// A sentence for each failed check of `folder`/selfcheck.json; none without this file. An unreadable file gives a
/// sentence too.
[[nodiscard]] std::vector<std::string> selfcheckProblems(const std::filesystem::path& folder);

}  // namespace dustbench::selfcheck
