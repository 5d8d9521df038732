// What the self-check beside results says against them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dustbench::bench {

/// A sentence for each failed check of `folder`/selfcheck.json; none without this file. An unreadable file is a
/// sentence too.
[[nodiscard]] std::vector<std::string> selfcheckProblems(const std::filesystem::path& folder);

}  // namespace dustbench::bench
