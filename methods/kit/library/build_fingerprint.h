// Build properties that two programs must share before C++ objects may pass between them: compiler, standard
// library, instruction set, GLM's configuration, floating-point rules, checks.
//
// A text of `name=value;` pairs, written by the preprocessor at the point of inclusion, so that it describes how that
// code is compiled. A macro that is not defined has its own name as value.
#pragma once

#include <glm/glm.hpp>
#include <string>

// NOLINTBEGIN(cppcoreguidelines-macro-usage): only the preprocessor knows macros' names and values
#define DUSTBENCH_EXPANDED(...) #__VA_ARGS__
#define DUSTBENCH_VALUE(...) DUSTBENCH_EXPANDED(__VA_ARGS__)
#define DUSTBENCH_FACT(name) #name "=" DUSTBENCH_VALUE(name) ";"
// NOLINTEND(cppcoreguidelines-macro-usage)

namespace dustbench::library {
namespace {

/// True if a·b + c is rounded once here. -ffp-contract decides this, but sets no macro.
[[nodiscard]] inline bool contractsProducts() {
    const volatile float a = 1 + 0x1p-12f, c = -1 - 0x1p-11f;
    const float x = a, z = c;
    return x * x + z != 0;  // a² = 1 + 2⁻¹¹ + 2⁻²⁴ loses its last term when rounded
}

/// The fingerprint of the code that includes this header.
[[nodiscard]] inline std::string buildFingerprint() {
    std::string facts;
    for (const char* fact : {DUSTBENCH_FACT(__VERSION__),
                             DUSTBENCH_FACT(__cplusplus),
                             DUSTBENCH_FACT(__GXX_ABI_VERSION),
                             DUSTBENCH_FACT(_GLIBCXX_RELEASE),
                             DUSTBENCH_FACT(_GLIBCXX_USE_CXX11_ABI),
                             DUSTBENCH_FACT(_GLIBCXX_ASSERTIONS),
                             DUSTBENCH_FACT(_GLIBCXX_DEBUG),
                             DUSTBENCH_FACT(__SSE4_2__),
                             DUSTBENCH_FACT(__AVX__),
                             DUSTBENCH_FACT(__AVX2__),
                             DUSTBENCH_FACT(__FMA__),
                             DUSTBENCH_FACT(__AVX512F__),
                             DUSTBENCH_FACT(__AVX512VL__),
                             DUSTBENCH_FACT(__FAST_MATH__),
                             DUSTBENCH_FACT(__NO_MATH_ERRNO__),
                             DUSTBENCH_FACT(__FINITE_MATH_ONLY__),
                             DUSTBENCH_FACT(NDEBUG),
                             DUSTBENCH_FACT(DUSTBENCH_CHECKED),
                             DUSTBENCH_FACT(__SANITIZE_ADDRESS__),
                             DUSTBENCH_FACT(__SANITIZE_THREAD__),
                             DUSTBENCH_FACT(GLM_VERSION_MAJOR),
                             DUSTBENCH_FACT(GLM_VERSION_MINOR),
                             DUSTBENCH_FACT(GLM_VERSION_PATCH),
                             DUSTBENCH_FACT(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES),
                             DUSTBENCH_FACT(GLM_FORCE_INTRINSICS),
                             DUSTBENCH_FACT(GLM_FORCE_DEPTH_ZERO_TO_ONE),
                             DUSTBENCH_FACT(GLM_FORCE_LEFT_HANDED),
                             DUSTBENCH_FACT(GLM_FORCE_CTOR_INIT),
                             DUSTBENCH_FACT(GLM_FORCE_SIZE_T_LENGTH),
                             DUSTBENCH_FACT(GLM_FORCE_SWIZZLE)})
        facts += fact;
    return facts + "fp-contract=" + (contractsProducts() ? "1;" : "0;");
}

}  // namespace
}  // namespace dustbench::library
