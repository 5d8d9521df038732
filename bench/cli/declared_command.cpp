#include "bench/cli/declared_command.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace dustbench::cli {

std::vector<std::string> DeclaredOption::words() const {
    static const std::regex list("[a-z0-9_]+(\\|[a-z0-9_]+)+", std::regex::optimize);
    std::vector<std::string> words;
    if (!std::regex_match(placeholder, list)) return words;
    std::istringstream text(placeholder);
    for (std::string word; std::getline(text, word, '|');) words.push_back(word);
    return words;
}

std::string DeclaredOption::listKind() const {
    static const std::regex reference("one of `dustbench list ([a-z]+)`", std::regex::optimize);
    std::smatch found;
    return std::regex_search(help, found, reference) ? found[1].str() : "";
}

bool DeclaredOption::takesFile() const {
    return placeholder.find("FILE") != std::string::npos || placeholder.find("DIR") != std::string::npos ||
           help.find("file") != std::string::npos;
}

}  // namespace dustbench::cli
