// A shader's text as embedded at build time, with the file name that compile errors are reported under.
#pragma once

#include <string_view>

namespace dustbench::gpu {

struct ShaderFile {
    std::string_view name;
    std::string_view text;
};

}  // namespace dustbench::gpu
