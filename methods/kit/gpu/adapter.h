// A way to OpenGL that this machine's EGL offers, and the rules by which one is taken.
//
// Pure: EGL itself is asked in egl_context.h.
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

    int index = 0;  ///< its place in the list
    /// `NVIDIA H200/PCIe/SSE2 (/dev/dri/renderD128)`, or `surfaceless`. Of a device on which no context was made yet,
    /// what EGL says: `EGL device 0 (/dev/dri/renderD128)`.
    std::string name{};
    std::string renderer{};  ///< OpenGL's; empty until a context was made
    Kind kind = Kind::hardware;
    Platform platform = Platform::device;
    std::string problem{};  ///< why it gives no OpenGL 4.5; empty: it does, or was not tried
};

[[nodiscard]] DUSTBENCH_API std::string_view kindName(Adapter::Kind kind);
[[nodiscard]] DUSTBENCH_API std::string_view platformName(Adapter::Platform platform);

/// True for the renderers that draw on the CPU.
[[nodiscard]] bool isSoftwareRenderer(std::string_view renderer);

/// The one to take where none is asked for: the first hardware device, else surfaceless, else a software device, of
/// those that have no problem. None where all have one.
[[nodiscard]] std::optional<std::size_t> preferredAdapter(std::span<const Adapter> adapters);
/// Has adapters opened, the preferred one of what is known first, until that one is open. `open` fills in the kind and
/// the problem that it finds: what EGL calls hardware may turn out to be drawn by the CPU. None where all have a
/// problem.
[[nodiscard]] std::optional<std::size_t> takePreferred(std::span<Adapter> adapters,
                                                       const std::function<void(Adapter&)>& open);
/// Why `preferredAdapter` takes this one, in a few words, with the hardware that could not be taken.
[[nodiscard]] std::string whyPreferred(std::span<const Adapter> adapters, std::size_t preferred);

/// The one whose index is asked for, if there is one.
[[nodiscard]] std::optional<std::size_t> adapterOfIndex(std::span<const Adapter> adapters, std::string_view asked);
/// The one with this index or name, else the only one whose name contains this text; case does not matter. A number is
/// an index.
/// Throws InputError with the list where none or several do.
[[nodiscard]] DUSTBENCH_API std::size_t findAdapter(std::span<const Adapter> adapters, std::string_view asked);

/// `0 surfaceless: no display; 1 …`: those with a problem, each with it.
[[nodiscard]] std::string problemsOf(std::span<const Adapter> adapters);

}  // namespace dustbench::gpu
