#include "bench/results/key_fields.h"

#include <fmt/format.h>

#include <sstream>

#include "methods/contract/errors.h"

namespace dustbench::bench {

KeyFields keyFields(const StoredRun& run) {
    const auto key = run.provenance.find("key");
    if (key == run.provenance.end() || key->second.empty())
        throw InputError(fmt::format("run '{}': has no provenance.key, which says what was measured", run.runId));
    KeyFields fields;
    std::istringstream lines(key->second);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos)
            throw InputError(
                fmt::format("run '{}': its provenance.key has the line '{}', expected name=value", run.runId, line));
        fields.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    }
    return fields;
}

}  // namespace dustbench::bench
