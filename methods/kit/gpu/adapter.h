// An OpenGL adapter offered by this machine's EGL, and the rules that choose one.
//
// Pure functions; egl_context.h queries EGL.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dustbench::gpu {

struct Adapter {
    enum class Kind { hardware, software };
    enum class Platform { device, surfaceless };

    int index = 0;  ///< position in the list
    /// `NVIDIA H200/PCIe/SSE2 (/dev/dri/renderD128)`, or `surfaceless`. For a device without a context so far, EGL's
    /// own description: `EGL device 0 (/dev/dri/renderD128)`.
    std::string name{};
    std::string renderer{};  ///< OpenGL's renderer; empty until a context has been made
    Kind kind = Kind::hardware;
    Platform platform = Platform::device;
    std::string problem{};  ///< why it provides no OpenGL 4.5; empty if it does, or was not tried
};

[[nodiscard]] DUSTBENCH_API std::string_view kindName(Adapter::Kind kind);
[[nodiscard]] DUSTBENCH_API std::string_view platformName(Adapter::Platform platform);

/// True for renderers that draw on the CPU.
[[nodiscard]] DUSTBENCH_API bool isSoftwareRenderer(std::string_view renderer);

/// The default choice: the first hardware device, else surfaceless, else a software device, among adapters without a
/// problem. Empty if every adapter has one.
[[nodiscard]] std::optional<std::size_t> preferredAdapter(std::span<const Adapter> adapters);
/// Opens the currently preferred adapter until one opens and remains preferred. `open` sets the kind and any problem
/// that it finds, since a device that EGL calls hardware may draw on the CPU. Empty if every adapter has a problem.
[[nodiscard]] std::optional<std::size_t> takePreferred(std::span<Adapter> adapters,
                                                       const std::function<void(Adapter&)>& open);
/// Short reason for the choice of `preferredAdapter`, with the hardware adapters that failed.
[[nodiscard]] std::string whyPreferred(std::span<const Adapter> adapters, std::size_t preferred);

/// The adapter with the requested index, if it exists.
[[nodiscard]] std::optional<std::size_t> adapterOfIndex(std::span<const Adapter> adapters, std::string_view asked);
/// The adapter with this index or name, else the only one whose name contains this text, ignoring case. A number is an
/// index. Throws InputError with the list if no adapter or several adapters match.
[[nodiscard]] DUSTBENCH_API std::size_t findAdapter(std::span<const Adapter> adapters, std::string_view asked);

/// `0 surfaceless: no display; 1 …`: the adapters with problems, and the problem of each.
[[nodiscard]] std::string problemsOf(std::span<const Adapter> adapters);

}  // namespace dustbench::gpu
