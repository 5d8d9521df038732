// OpenGL's complaints as exceptions: failed allocations always, every debug message in checked builds
// (DUSTBENCH_CHECKED: the `dev` and `asan` presets).
#pragma once

#include <cstddef>
#include <string_view>

namespace dustbench::gpu {

#ifdef DUSTBENCH_CHECKED
/// From now on errors and undefined behaviour that the driver reports are kept. The context must have the debug flag.
void listenToDebugOutput();

/// Throws std::runtime_error where OpenGL has complained since the last call; `where` names what was being done.
/// The driver's callback itself must not throw: its C frames may hold locks.
void throwOnDebugOutput(std::string_view where);
#else
inline void listenToDebugOutput() {}
inline void throwOnDebugOutput(std::string_view) {}
#endif

/// In every build: throws std::runtime_error where OpenGL could not allocate what it was just asked for.
void requireAllocated(std::string_view label, std::size_t bytes);

}  // namespace dustbench::gpu
