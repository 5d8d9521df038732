// A shader's text, embedded at build time, with the file name for compile errors.
#pragma once

#include <string_view>

namespace dustbench::gpu {

struct ShaderFile {
    std::string_view name;
    std::string_view text;
};

}  // namespace dustbench::gpu
