// The interface of a library `<id>.dustmethod.so` with a method, parts of particle systems, or both: one C function,
// called before any C++ object is passed. The CMake package generates the source that defines it
// (package/dustbench_add_method.cmake).
#pragma once

#include <cstdint>

namespace dustbench::library {

/// Incremented with every change of contract or kit that breaks existing libraries.
inline constexpr std::uint32_t methodApi = 3;

/// `api` is the first member in every version.
struct MethodEntry {
    std::uint32_t api;
    const char* fingerprint;  ///< build_fingerprint.h, as the library was compiled
    const char* id;
    // To be called only if `api` and `fingerprint` equal the program's own; null if the library has none.
    void (*describe)(void* methodInfo);      ///< assigns to a MethodInfo
    void (*describeParts)(void* partInfos);  ///< appends to a vector of PartInfo, with kind and name
};

inline constexpr const char* methodEntryName = "dustbenchMethodEntry";
using MethodEntryFunction = const MethodEntry* (*)();

}  // namespace dustbench::library
