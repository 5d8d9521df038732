// An OpenGL 4.5 core context without a window, on one of the adapters that EGL offers.
//
// Owns: the context; displays stay with the process, since another context may use them. Threads: the one that made it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "methods/kit/gpu/adapter.h"

namespace dustbench::gpu {

class EglContext {
 public:
    /// Makes a context and makes it current. Fills in the adapter's renderer, name and kind; or its problem, and gives
    /// none.
    [[nodiscard]] static std::unique_ptr<EglContext> open(Adapter& adapter);
    ~EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

 private:
    EglContext() = default;
    [[nodiscard]] std::string connect(const Adapter& adapter);

    void* display_ = nullptr;
    void* context_ = nullptr;
};

/// What EGL offers, its devices first, none of it tried: names and kinds are what EGL says. Throws InputError where EGL
/// offers nothing of the sort.
[[nodiscard]] std::vector<Adapter> offeredAdapters();
/// The same, each tried with a context that is gone again; what was current stays current. Throws InputError.
[[nodiscard]] DUSTBENCH_API std::vector<Adapter> listAdapters();

}  // namespace dustbench::gpu
