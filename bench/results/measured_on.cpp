#include "bench/results/measured_on.h"

#include <array>

namespace dustbench::bench {
namespace {

constexpr std::array<std::string_view, 7> machine{"cpu",         "cores",       "governor",  "gl_vendor",
                                                  "gl_renderer", "gl_platform", "build_type"};
constexpr std::array<std::string_view, 7> circumstances{"version", "git_commit", "compiler", "flags",
                                                        "kernel",  "gl_version", "ram_bytes"};

}  // namespace

std::span<const std::string_view> machineFields() {
    return machine;
}

std::span<const std::string_view> circumstanceFields() {
    return circumstances;
}

std::vector<FieldDifference> differences(const StoredRun& first, const StoredRun& second,
                                         std::span<const std::string_view> fields) {
    const auto textOf = [](const StoredRun& run, std::string_view field) {
        const auto found = run.provenance.find(field);
        return found == run.provenance.end() ? std::string() : found->second;
    };
    std::vector<FieldDifference> list;
    for (const std::string_view field : fields)
        if (std::string a = textOf(first, field), b = textOf(second, field); a != b)
            list.push_back({std::string(field), std::move(a), std::move(b)});
    return list;
}

}  // namespace dustbench::bench
