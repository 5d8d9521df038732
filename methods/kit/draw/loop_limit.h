// Finds out whether the driver has ended the loops of a shader early.
//
// Mesa's llvmpipe ends all loops of an invocation after 65,535 iterations in total, without an error: a pixel that goes
// through more puffs would show a part of them. A shader with loop_limit.glsl calls isCutShort() at its end and counts
// the pixels of which that is true in `unfinished` (storage binding 6). Hardware has no such limit.
#pragma once

#include <string_view>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::draw {

class DUSTBENCH_API LoopLimit {
 public:
    explicit LoopLimit(gpu::Device& device);

    /// Before each pass.
    void bind(gpu::Program& program);
    /// For Method::report of methods that report at the end; waits for the passes, on software renderers only. Throws
    /// InputError if a pixel of any pass so far is unfinished; `method` begins the message.
    void requireWholeLoops(std::string_view method) const;

 private:
    gpu::Device& device_;
    gpu::Buffer unfinished_;
};

}  // namespace dustbench::draw
