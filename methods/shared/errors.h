// Errors that a person can mend: wrong names, values, files, machines. The command turns them into one line and exit
// code 3.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace dustbench {

/// Bad input or an unusable machine. The message is one line: what it concerns, what was got, what is allowed.
class InputError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// `unknown method 'bilboard' (did you mean 'billboard'?); known: billboard, octree_search`
/// The suggestion is left out where nothing is near.
[[nodiscard]] InputError unknownName(std::string_view kind, std::string_view got, std::span<const std::string> known);

/// The known name nearest by edit distance, or empty where all differ by more than a third of their letters.
[[nodiscard]] std::string nearestName(std::string_view got, std::span<const std::string> known);

}  // namespace dustbench
