// The border of a library that holds a method, parts of particle systems, or both, `<id>.dustmethod.so`: one function
// of C, called before any object of C++ crosses. The CMake package writes the source that defines it
// (package/dustbench_add_method.cmake).
#pragma once

#include <cstdint>

namespace dustbench::library {

/// Changes with every change of contract or kit that a library built before does not survive.
inline constexpr std::uint32_t methodApi = 3;

/// `api` stays first in every version.
struct MethodEntry {
    std::uint32_t api;
    const char* fingerprint;  ///< build_fingerprint.h, as the library was compiled
    const char* id;
    // To be called if interface and fingerprint are the program's own; null if the library has nothing of the sort.
    void (*describe)(void* methodInfo);      ///< assigns to a MethodInfo
    void (*describeParts)(void* partInfos);  ///< appends to a vector of PartInfo, with kind and name
};

inline constexpr const char* methodEntryName = "dustbenchMethodEntry";
using MethodEntryFunction = const MethodEntry* (*)();

}  // namespace dustbench::library
