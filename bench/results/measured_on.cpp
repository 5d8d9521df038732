#include "bench/results/measured_on.h"

#include <algorithm>
#include <array>
#include <map>

namespace dustbench::bench {
namespace {

constexpr std::array<std::string_view, 7> machine{"cpu",         "cores",       "governor",  "gl_vendor",
                                                  "gl_renderer", "gl_platform", "build_type"};
constexpr std::array<std::string_view, 9> circumstances{
    "version", "git_commit", "compiler", "flags", "kernel", "gl_version", "ram_bytes", "quota_cores", "environment"};

}  // namespace

std::span<const std::string_view> machineFields() {
    return machine;
}

std::span<const std::string_view> circumstanceFields() {
    return circumstances;
}

std::vector<std::string> valuesOf(const StoredRun& run, std::span<const std::string_view> fields) {
    std::vector<std::string> values;
    values.reserve(fields.size());
    for (const std::string_view field : fields) {
        const auto found = run.provenance.find(field);
        values.push_back(found == run.provenance.end() ? std::string() : found->second);
    }
    return values;
}

std::string differingInput(const StoredRun& first, const StoredRun& second) {
    std::map<std::string, std::string> hashes;
    for (const InputHash& input : first.inputs) hashes[input.file] = input.sha256;
    for (const InputHash& input : second.inputs) {
        const auto found = hashes.find(input.file);
        if (found == hashes.end() || found->second != input.sha256) return input.file;
        hashes.erase(found);
    }
    return hashes.empty() ? std::string() : hashes.begin()->first;
}

bool areOneMeasurement(const StoredRun& a, const StoredRun& b) {
    const auto started = a.provenance.find("started_utc");
    if (a.runId != b.runId || started == a.provenance.end() || started->second.empty()) return false;
    const auto same = [](const OutputFile& x, const OutputFile& y) { return x.file == y.file && x.sha256 == y.sha256; };
    const std::vector<OutputFile> none;
    return a.provenance == b.provenance && a.cells == b.cells &&
           std::ranges::equal(a.outputs ? *a.outputs : none, b.outputs ? *b.outputs : none, same);
}

std::vector<FieldDifference> differences(const StoredRun& first, const StoredRun& second,
                                         std::span<const std::string_view> fields) {
    const std::vector<std::string> a = valuesOf(first, fields), b = valuesOf(second, fields);
    std::vector<FieldDifference> list;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (a[i] != b[i]) list.push_back({std::string(fields[i]), a[i], b[i]});
    return list;
}

}  // namespace dustbench::bench
