// Short notations for several values: lists `a,b,c` and ranges `a:b:step`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dustbench::suite {

/// `5:40:5` counts from 5 in steps of 5 and includes 40; a negative step counts down. `a,b,c` is a list of values or
/// ranges; anything else is one value. `what` names it in messages. Throws InputError.
[[nodiscard]] std::vector<std::string> expandValues(std::string_view what, std::string_view text);

}  // namespace dustbench::suite
