// OpenGL contexts of EGL: an OpenGL 4.5 core context without a window, on one of the adapters that EGL offers; and the
// current context, which is restored after another one was used, or found to be lost.
//
// Owns: the context. Displays are never closed, since other contexts may use them. Threads: the context's.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "methods/kit/gpu/adapter.h"

namespace dustbench::gpu {

class EglContext {
 public:
    /// Makes a context and makes it current. Sets the adapter's renderer, name and kind; on failure sets its problem
    /// and returns null.
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

/// The adapters that EGL offers, devices first, untested: names and kinds are EGL's. Throws InputError if EGL offers
/// none.
[[nodiscard]] std::vector<Adapter> offeredAdapters();
/// The same, each tested with a temporary context; the current context stays current. Throws InputError.
[[nodiscard]] DUSTBENCH_API std::vector<Adapter> listAdapters();

/// Remembers the EGL context that is current at construction, with its surfaces. It must stay alive.
class DUSTBENCH_API CurrentContext {
 public:
    CurrentContext();
    /// Throws std::runtime_error on failure.
    void makeCurrent() const;

 private:
    void *display_, *drawn_, *read_, *context_;
};

/// True if the driver has reset the GPU and its memory is lost. Works only for contexts that report resets.
[[nodiscard]] DUSTBENCH_API bool isContextLost();

}  // namespace dustbench::gpu
