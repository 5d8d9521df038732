// The OpenGL 4.5 context, and the ledger of everything that lives on it.
//
// Owns: the OpenGL context, unless it was adopted. Threads: everything in gpu/ belongs to the thread that made the
// Device.
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
    std::string adapter{};     ///< its name (adapter.h); empty where the context was adopted
    int adapterIndex = -1;     ///< its place in the list; -1 where the context was adopted
    std::string adapterWhy{};  ///< `first hardware adapter`, `--adapter 1` …
};

/// What every Device of this process and of its children is to be made on (findAdapter), instead of the preferred one:
/// $DUSTBENCH_ADAPTER. Empty: nothing is asked for.
[[nodiscard]] DUSTBENCH_API std::string askedAdapter();
DUSTBENCH_API void askForAdapter(const std::string& asked);

class DUSTBENCH_API Device {
 public:
    /// On the adapter that is asked for, else on the preferred one (preferredAdapter). Throws InputError where there is
    /// none or it gives no OpenGL 4.5, saying what was tried.
    Device();
    /// On the context that somebody else made and that is current now: whoever made it keeps it, and keeps it current.
    /// Its state is this Device's from now on; nothing is put back. Throws InputError unless it is OpenGL 4.5 core.
    [[nodiscard]] static Device adoptCurrent();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceInfo& info() const { return info_; }
    /// Where new buffers and textures are booked by their labels: the device's own, unless a LedgerScope says else.
    [[nodiscard]] MemoryLedger& ledger() { return *bookedOn_; }
    /// What the driver says is free on the GPU, for all of the machine's programs; empty where it does not tell.
    [[nodiscard]] std::optional<std::int64_t> driverFreeBytes() const;
    /// The largest buffer that a shader may store into.
    [[nodiscard]] std::size_t maximumStorageBytes() const;
    /// True where OpenGL runs on the CPU.
    [[nodiscard]] bool isSoftware() const;
    /// Blocks until all queued work is done.
    void finish();

 private:
    struct Adopted {};
    explicit Device(Adopted);
    void begin();

    std::unique_ptr<EglContext> context_;  ///< none where it was adopted
    DeviceInfo info_;
    MemoryLedger ledger_;
    MemoryLedger* bookedOn_ = &ledger_;

    friend class LedgerScope;
};

/// Books what is made in the rest of its block on another ledger, which must outlive it all: a ledger for each user of
/// a device. Scopes nest.
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
