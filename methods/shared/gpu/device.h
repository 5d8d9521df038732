// The OpenGL 4.5 context, without a window, and the ledger of everything that lives on it.
//
// Owns: the OpenGL context; the EGL display stays with the process. Threads: everything in gpu/ belongs to the thread
// that made the Device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "methods/shared/memory_ledger.h"

namespace dustbench::gpu {

struct DeviceInfo {
    std::string vendor;
    std::string renderer;
    std::string version;
    std::string platform;  ///< `surfaceless` or `device`
};

class Device {
 public:
    /// EGL surfaceless first, an EGL device next. Throws InputError where neither gives OpenGL 4.5, saying what was
    /// tried.
    Device();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] const DeviceInfo& info() const { return info_; }
    /// Bytes of every buffer and texture, by their labels.
    [[nodiscard]] MemoryLedger& ledger() { return ledger_; }
    /// What the driver says is free on the GPU, for all of the machine's programs; empty where it does not tell.
    [[nodiscard]] std::optional<std::int64_t> driverFreeBytes() const;
    /// The largest buffer that a shader may store into.
    [[nodiscard]] std::size_t mostStorageBytes() const;
    /// True where OpenGL runs on the CPU (Mesa's llvmpipe and softpipe).
    [[nodiscard]] bool isSoftware() const;
    /// Blocks until all queued work is done.
    void finish();

 private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
    DeviceInfo info_;
    MemoryLedger ledger_;
};

}  // namespace dustbench::gpu
