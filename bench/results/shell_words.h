// Words of a POSIX shell's command line: quotes them, and takes a line apart.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dustbench::bench {

/// The text as one word, quoted if necessary.
[[nodiscard]] std::string shellQuoted(const std::string& text);

/// The words of a line: quotes and backslashes as a shell reads them, a backslash before a line break continues the
/// line. Variables and other expansions stay as they are. Throws InputError for a quote that is never closed.
[[nodiscard]] std::vector<std::string> shellWords(std::string_view line);

}  // namespace dustbench::bench
