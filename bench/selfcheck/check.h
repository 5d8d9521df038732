// One finding about this machine: what was measured, what is expected, and whether it is right.
#pragma once

#include <string>

#include "methods/contract/choices.h"

namespace dustbench::bench {

/// attention: the program works around it, but results mean less. failed: results of this machine are wrong.
enum class Outcome { ok, attention, failed };
inline constexpr Choices<Outcome> outcomes{
    {"ok", Outcome::ok}, {"attention", Outcome::attention}, {"failed", Outcome::failed}};

struct Check {
    std::string name;
    Outcome outcome = Outcome::ok;
    std::string measured;
    std::string expected;  ///< empty for a plain fact
    std::string note{};    ///< what it means for results; empty where the outcome says enough
};

}  // namespace dustbench::bench
