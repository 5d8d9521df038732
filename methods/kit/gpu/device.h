// The OpenGL 4.5 context, and the ledger of everything that lives on it.
//
// Owns: the OpenGL context, unless adopted. Threads: everything in gpu/ belongs to the thread that made the Device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::gpu {

class EglContext;

struct DeviceInfo {
    std::string vendor{};
    std::string renderer{};
    std::string version{};
    std::string platform{};    ///< `surfaceless`, `device`, or `adopted`
    std::string adapter{};     ///< the adapter's name (adapter.h); empty if the context was adopted
    int adapterIndex = -1;     ///< the adapter's position in the list; -1 if the context was adopted
    std::string adapterWhy{};  ///< `first hardware adapter`, `--adapter 1` …
};

/// The adapter (findAdapter) for every Device of this process and its children, overriding the preferred one:
/// $DUSTBENCH_ADAPTER. Empty if none is requested.
[[nodiscard]] DUSTBENCH_API std::string askedAdapter();
DUSTBENCH_API void askForAdapter(const std::string& asked);

class DUSTBENCH_API Device {
 public:
    /// Uses the requested adapter, else the preferred one (preferredAdapter). Throws InputError with the adapters tried
    /// if there is none or it provides no OpenGL 4.5.
    Device();
    /// Adopts the current context. The caller keeps ownership and must keep it current. From now on this Device
    /// controls its state and restores none of it. Throws InputError unless the context is OpenGL 4.5 core.
    [[nodiscard]] static Device adoptCurrent();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceInfo& info() const { return info_; }
    /// The ledger that new buffers and textures are booked on: the device's own, unless a LedgerScope overrides it.
    [[nodiscard]] MemoryLedger& ledger() { return *bookedOn_; }
    /// Free GPU memory as reported by the driver, shared by all programs on the machine; empty if not reported.
    [[nodiscard]] std::optional<std::int64_t> driverFreeBytes() const;
    /// Maximum size of a shader storage buffer.
    [[nodiscard]] std::size_t maximumStorageBytes() const;
    /// Whether OpenGL has this extension: `GL_ARB_gpu_shader_int64`.
    [[nodiscard]] bool offers(const std::string& extension) const;
    /// Threads of a subgroup in compute shaders; 0 if shaders cannot exchange values within it (ballot, shuffle, sums).
    [[nodiscard]] int subgroupThreads() const;
    /// True if OpenGL runs on the CPU.
    [[nodiscard]] bool isSoftware() const;
    /// Blocks until all queued work is done.
    void finish();

 private:
    struct Adopted {};
    explicit Device(Adopted);
    void begin();

    std::unique_ptr<EglContext> context_;  ///< null if adopted
    DeviceInfo info_;
    MemoryLedger ledger_;
    MemoryLedger* bookedOn_ = &ledger_;

    friend class LedgerScope;
};

/// Books all objects made in the rest of the block on another ledger, which must outlive them: one ledger per user of a
/// device. Scopes nest.
class [[nodiscard]] LedgerScope {
 public:
    LedgerScope(Device& device, MemoryLedger& ledger)
        : device_(device), before_(std::exchange(device.bookedOn_, &ledger)) {}
    ~LedgerScope() { device_.bookedOn_ = before_; }
    LedgerScope(const LedgerScope&) = delete;
    LedgerScope& operator=(const LedgerScope&) = delete;

 private:
    Device& device_;
    MemoryLedger* before_;
};

}  // namespace dustbench::gpu
