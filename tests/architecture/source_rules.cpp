#include "tests/architecture/source_rules.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <regex>
#include <sstream>
#include <tuple>

namespace dustbench::architecture {
namespace {

constexpr std::size_t maximumLines = 400;

std::vector<std::string> linesOf(std::string_view text) {
    std::vector<std::string> lines;
    std::istringstream stream{std::string(text)};
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string fault(const SourceFile& file, std::size_t lineIndex, const std::string& what) {
    return file.path + ":" + std::to_string(lineIndex + 1) + ": " + what;
}

/// `methods/billboard` of `methods/billboard/parts/a.h`, `methods/kit` of `methods/kit/gpu/a.h`, and `bench` of
/// `bench/run/a.h`.
std::string territoryOf(const std::string& path) {
    const auto first = path.find('/');
    const std::string top = path.substr(0, first);
    if (top != "methods" || first == std::string::npos) return top;
    return path.substr(0, path.find('/', first + 1));
}

/// The modules of bench/: each may use those before it.
constexpr std::array<std::string_view, 13> benchModules{"world",  "measure",   "export", "reference", "results",
                                                        "suite",  "claims",    "run",    "selfcheck", "view",
                                                        "report", "recommend", "cli"};

/// `run` of `bench/run/a.h`; nothing for files outside the folders of bench/.
std::optional<std::string> benchFolder(const std::string& path) {
    if (!path.starts_with("bench/") || path.find('/', 6) == std::string::npos) return std::nullopt;
    return path.substr(6, path.find('/', 6) - 6);
}

/// The position of a file's module in that order; nothing for other files.
std::optional<std::size_t> positionInBench(const std::string& path) {
    const auto folder = benchFolder(path);
    const auto module = folder ? std::ranges::find(benchModules, *folder) : benchModules.end();
    if (module == benchModules.end()) return std::nullopt;
    return static_cast<std::size_t>(module - benchModules.begin());
}

/// `export` is a keyword of C++.
std::string namespaceOf(std::string_view benchModule) {
    return "dustbench::" + std::string(benchModule == "export" ? "exports" : benchModule);
}

bool mayInclude(const std::string& from, const std::string& to) {
    if (from == to || to == "methods/contract") return true;
    if (from == "methods/contract") return !to.starts_with("methods/") && to != "bench" && to != "tests";
    if (to == "methods/kit") return true;
    const bool toMethod = to.starts_with("methods/");
    if (from.starts_with("methods/")) return !toMethod && to != "bench" && to != "tests";
    if (from == "bench") return !toMethod && to != "tests";
    return true;
}

bool isContractTest(const SourceFile& file) {
    return file.path.starts_with("methods/contract/") && file.path.ends_with("_test.cpp");
}
bool isHeader(const SourceFile& file) {
    return file.path.ends_with(".h");
}
bool isCxx(const SourceFile& file) {
    return isHeader(file) || file.path.ends_with(".cpp");
}

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string firstWord(std::string_view text) {
    return {text.begin(), std::ranges::find_if_not(text, isWordCharacter)};
}

/// The rest after `start`, or nothing if the text does not begin with it.
std::optional<std::string_view> after(std::string_view line, std::string_view start) {
    if (!line.starts_with(start)) return std::nullopt;
    return line.substr(start.size());
}

/// `std::map<a, b> f(int)` without the text in angle brackets.
std::string withoutArguments(std::string_view line) {
    std::string kept;
    int depth = 0;
    for (const char c : line) {
        const bool closes = c == '>' && depth > 0;
        if (c == '<') ++depth;
        if (depth == 0) kept += c;
        if (closes) --depth;
    }
    return kept;
}

/// The function or variable that a line declares; empty if none or a member of a class.
std::string declaredName(std::string_view line) {
    const std::string text = withoutArguments(line);
    const std::size_t end = std::min(text.find_first_of("(={[;"), text.size());
    std::size_t last = end;
    while (last > 0 && text[last - 1] == ' ') --last;
    std::size_t first = last;
    while (first > 0 && isWordCharacter(text[first - 1])) --first;
    const bool isAfterType = first > 0 && (text[first - 1] == ' ' || text[first - 1] == '*' || text[first - 1] == '&');
    return isAfterType && end < text.size() ? text.substr(first, last - first) : "";
}

std::string nameIn(std::string_view line) {
    static constexpr std::array<std::string_view, 4> types{"struct ", "class ", "enum class ", "union "};
    for (const std::string_view type : types)
        if (const auto rest = after(line, type)) return firstWord(*rest);
    if (const auto rest = after(line, "using ")) return rest->find('=') == rest->npos ? "" : firstWord(*rest);
    if (after(line, "namespace ") || after(line, "template ")) return "";
    return declaredName(line);
}

/// The unit that is compiled together: a folder with its `parts/`, and whether it is a module, tests or benchmarks.
std::string moduleOf(const std::string& path) {
    const std::string folder = path.substr(0, std::min(path.find("/parts/"), path.rfind('/')));
    return folder + (path.ends_with("_test.cpp") ? " tests" : path.ends_with("_bench.cpp") ? " benchmarks" : "");
}

}  // namespace

Faults includeFaults(const SourceFile& file) {
    static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
    Faults faults;
    const auto lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (!std::regex_search(lines[i], match, include)) continue;
        const std::string target = match[1];
        if (target.find("..") != std::string::npos) {
            faults.push_back(fault(file, i, "includes '" + target + "', expected a path from the root of the tree"));
        } else if (isContractTest(file) && target.starts_with("methods/kit/testing/")) {
            continue;
        } else if (!mayInclude(territoryOf(file.path), territoryOf(target))) {
            faults.push_back(fault(file, i, "must not include '" + target + "'"));
        } else if (positionInBench(target) > positionInBench(file.path) && positionInBench(file.path)) {
            faults.push_back(fault(file, i, "must not include '" + target + "', which depends on it"));
        }
    }
    return faults;
}

Faults namespaceFaults(const SourceFile& file) {
    const auto folder = benchFolder(file.path);
    if (!folder || !isCxx(file)) return {};
    if (!positionInBench(file.path))
        return {fault(file, 0, "bench/" + *folder + " has no place in the order of modules (source_rules.cpp)")};
    static const std::regex named(R"re(^namespace (dustbench(::\w+)?))re");
    const std::string own = namespaceOf(*folder);
    Faults faults;
    const auto lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (!std::regex_search(lines[i], match, named) || match[1] == own) continue;
        const bool isOfBench =
            std::ranges::any_of(benchModules, [&](std::string_view each) { return match[1] == namespaceOf(each); });
        if (isOfBench || match[1] == "dustbench")
            faults.push_back(fault(file, i, "got namespace " + match.str(1) + ", expected " + own));
    }
    return faults;
}

Faults contractFaults(const SourceFile& file) {
    static const std::regex include(R"re(^\s*#\s*include\s*([<"][^>"]+[>"]))re");
    static const std::regex allowed(R"re(<[a-z_]+>|<glm/[\w/]+\.hpp>|"methods/contract/\w+\.h")re");
    if (!file.path.starts_with("methods/contract/") || !isHeader(file)) return {};
    Faults faults;
    const auto lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch match;
        if (std::regex_search(lines[i], match, include) && !std::regex_match(match[1].str(), allowed))
            faults.push_back(
                fault(file, i, "the contract may include only the standard library and GLM, not " + match.str(1)));
    }
    return faults;
}

std::map<std::string, std::set<std::string>> kitUsers(const std::vector<SourceFile>& files) {
    static const std::regex include(R"re(#\s*include\s*"methods/kit/(\w+)/)re");
    static const std::regex kitFolder(R"re(^methods/kit/(\w+)/)re");
    std::map<std::string, std::set<std::string>> users;
    for (const SourceFile& file : files)  // folders without users also get an entry
        if (std::smatch own; std::regex_search(file.path, own, kitFolder)) users[own[1]];
    std::map<std::string, std::set<std::string>> folders;  // that include a folder, within the kit
    for (const SourceFile& file : files) {
        std::smatch own;
        const bool inKit = std::regex_search(file.path, own, kitFolder);
        const std::string territory = territoryOf(file.path);
        if (!inKit && !territory.starts_with("methods/") && territory != "bench") continue;
        for (std::sregex_iterator at(file.text.begin(), file.text.end(), include), end; at != end; ++at)
            (inKit ? folders : users)[(*at)[1]].insert(inKit ? own[1].str() : territory);
    }
    for (bool grown = true; grown;) {
        grown = false;
        for (const auto& [folder, through] : folders)
            for (const std::string& other : through)
                for (const std::string& user : std::set(users[other])) grown |= users[folder].insert(user).second;
    }
    return users;
}

Faults openGlFaults(const SourceFile& file) {
    static const std::array rules{
        std::regex(R"re(\bgl[A-Z]\w*\s*\()re"),
        std::regex(R"re(\bGL(u?int(64)?|enum|sizei(ptr)?|intptr|bitfield|boolean|u?byte|u?short|sync|char)\b)re"),
        std::regex(R"re(^\s*#\s*include\s*[<"](epoxy|GL|GLES\d?|EGL)/)re")};
    if (!isCxx(file) || file.path.starts_with("methods/kit/gpu/")) return {};
    Faults faults;
    const auto lines = linesOf(codeOnly(file.text));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (const std::regex& rule : rules) {
            std::smatch match;
            if (std::regex_search(lines[i], match, rule)) {
                faults.push_back(fault(file, i, "raw OpenGL outside methods/kit/gpu: '" + match.str() + "'"));
            }
        }
    }
    return faults;
}

Faults lengthFaults(const SourceFile& file) {
    static const std::regex excuse(R"re(Over 400 lines: \w+)re");
    const auto lines = linesOf(file.text);
    if (lines.size() <= maximumLines) return {};
    const bool excused =
        std::ranges::any_of(lines, [](const std::string& line) { return std::regex_search(line, excuse); });
    if (excused) return {};
    return {
        fault(file, maximumLines, std::to_string(lines.size()) + " lines: split it, or state 'Over 400 lines: why'")};
}

Faults purposeFaults(const SourceFile& file) {
    static const std::regex sentence(R"re(^// \w+.*)re");
    if (!isHeader(file)) return {};
    const auto lines = linesOf(file.text);
    if (!lines.empty() && std::regex_match(lines.front(), sentence)) return {};
    return {fault(file, 0, "a header begins with one sentence on its purpose")};
}

Faults citationFaults(const SourceFile& file, const std::set<std::string>& keys) {
    static const std::regex citation(R"re((//.*\bSource: *|\bsource = ")([A-Za-z][\w:+-]*))re");
    static const std::regex further(R"re(; ([A-Z][A-Za-z]+[12]\d\d\d[a-z]?)\b)re");
    Faults faults;
    const auto lines = linesOf(file.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto demand = [&](const std::string& key) {
            if (!keys.contains(key)) faults.push_back(fault(file, i, "'" + key + "' is not in data/references.bib"));
        };
        std::smatch match;
        if (!std::regex_search(lines[i], match, citation)) continue;
        demand(match[2]);
        for (std::sregex_iterator next(lines[i].begin(), lines[i].end(), further), end; next != end; ++next) {
            demand((*next)[1]);
        }
    }
    return faults;
}

std::set<std::string> bibliographyKeys(std::string_view bibtex) {
    static const std::regex entry(R"re(^\s*@\w+\s*\{\s*([^,\s]+)\s*,)re");
    std::set<std::string> keys;
    for (const std::string& line : linesOf(bibtex)) {
        std::smatch match;
        if (std::regex_search(line, match, entry)) keys.insert(match[1]);
    }
    return keys;
}

std::vector<std::string> quotedNames(std::string_view markdown) {
    static const std::regex quoted("`([^`]+)`");
    std::vector<std::string> names;
    for (const std::string& line : linesOf(markdown)) {
        for (std::sregex_iterator match(line.begin(), line.end(), quoted), end; match != end; ++match) {
            names.push_back((*match)[1]);
        }
    }
    return names;
}

bool isNamed(const std::string& path, const std::vector<std::string>& names) {
    return std::ranges::any_of(names, [&path](const std::string& name) {
        return fnmatch(name.c_str(), path.c_str(), FNM_PATHNAME | FNM_PERIOD) == 0;
    });
}

std::string codeOnly(std::string_view text) {
    static constexpr std::string_view rawStart = "R\"";
    std::string code(text);
    const auto blank = [&code](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < std::min(end, code.size()); ++i) {
            if (code[i] != '\n') code[i] = ' ';
        }
    };
    const auto after = [&text](std::string_view what, std::size_t from) {
        const auto found = text.find(what, from);
        return found == std::string_view::npos ? text.size() : found + what.size();
    };
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        std::size_t end = i + 1;
        if (rest.starts_with("//")) {
            end = std::min(text.find('\n', i), text.size());
            blank(i, end);
        } else if (rest.starts_with("/*")) {
            end = after("*/", i + 2);
            blank(i, end);
        } else if (rest.starts_with(rawStart)) {
            const auto open = std::min(text.find('(', i), text.size());
            std::string close(")");
            close.append(text.substr(i + 2, open - i - 2)).push_back('"');
            end = after(close, open);
            blank(i, end);
        } else if (rest.starts_with("#include")) {
            end = std::min(text.find('\n', i), text.size());
        } else if (rest.front() == '"' ||
                   (rest.front() == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
            // Apostrophes inside numbers (1'000) follow a digit and open nothing.
            while (end < text.size() && text[end] != rest.front() && text[end] != '\n')
                end += text[end] == '\\' ? 2 : 1;
            ++end;
            blank(i + 1, end - 1);
        }
        i = end;
    }
    return code;
}

std::vector<OwnName> ownNames(std::string_view text) {
    std::vector<OwnName> names;
    std::istringstream lines{std::string(text)}, codeLines(codeOnly(text));
    std::string space;
    bool isUnnamed = false;
    std::size_t number = 0;
    for (std::string line, whole; std::getline(codeLines, line) && std::getline(lines, whole);) {
        ++number;
        while (line.ends_with(' ')) line.pop_back();
        if (line == "namespace {") {
            isUnnamed = true;
        } else if (const auto named = after(line, "namespace "); named && named->ends_with(" {")) {
            space = named->substr(0, named->size() - 2);
        } else if (whole == "}  // namespace") {
            isUnnamed = false;
        } else if (isUnnamed && !line.empty() && std::isalpha(static_cast<unsigned char>(line.front()))) {
            if (std::string name = nameIn(line); !name.empty()) names.push_back({std::move(name), space, number});
        }
    }
    return names;
}

Faults sharedNameFaults(const std::vector<SourceFile>& files) {
    std::map<std::tuple<std::string, std::string, std::string>, const SourceFile*> declaredBy;
    Faults faults;
    for (const SourceFile& file : files) {
        if (!file.path.ends_with(".cpp")) continue;
        for (const OwnName& own : ownNames(file.text)) {
            const auto [first, isNew] = declaredBy.try_emplace({moduleOf(file.path), own.space, own.name}, &file);
            if (!isNew && first->second != &file)
                faults.push_back(file.path + ":" + std::to_string(own.line) + ": '" + own.name +
                                 "' is also a name in " + first->second->path + ", with which it may be compiled");
        }
    }
    return faults;
}

}  // namespace dustbench::architecture
