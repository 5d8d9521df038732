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

    /// Before the pass runs.
    void bind(gpu::Program& program);
    /// After it, on software renderers only: waits for the pass. Throws InputError if a pixel is unfinished; `what`
    /// begins the message, `linked_list: the list of fragments`.
    void requireWholeLoops(std::string_view what) const;

 private:
    gpu::Device& device_;
    gpu::Buffer unfinished_;
};

}  // namespace dustbench::draw
