// Turns OpenGL errors into exceptions: failed allocations in every build, all debug messages in checked builds
// (DUSTBENCH_CHECKED: the `dev` and `asan` presets).
#pragma once

#include <cstddef>
#include <string_view>

namespace dustbench::gpu {

#ifdef DUSTBENCH_CHECKED
/// Starts recording the errors and undefined behaviour that the driver reports. The context must have the debug flag.
void listenToDebugOutput();

/// Throws std::runtime_error if OpenGL has reported a problem since the last call; `where` names the operation. The
/// driver's callback itself must not throw: its C frames may hold locks.
void throwOnDebugOutput(std::string_view where);
#else
inline void listenToDebugOutput() {}
inline void throwOnDebugOutput(std::string_view) {}
#endif

/// In every build: throws InputError if OpenGL could not make the last allocation.
void requireAllocated(std::string_view label, std::size_t bytes);

}  // namespace dustbench::gpu
