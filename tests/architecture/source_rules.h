// The rules for the project's source files, as functions of a file's path and text.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::architecture {

struct SourceFile {
    std::string path;  ///< from the root of the tree, with '/'
    std::string text;
};

/// Violations of a rule, each as `path:line: fault`.
using Faults = std::vector<std::string>;

/// Includes point one way: methods/<id> → methods/kit → methods/contract ← bench, and within bench/ from later modules
/// to earlier ones. No include path contains `..`.
[[nodiscard]] Faults includeFaults(const SourceFile& file);

/// A file of a module of bench/ has the module's namespace: `dustbench::run` in bench/run, `dustbench::exports` in
/// bench/export. A folder of bench/ has a place in the order of modules.
[[nodiscard]] Faults namespaceFaults(const SourceFile& file);

/// A header of methods/contract includes only the standard library, GLM and other headers of the contract.
[[nodiscard]] Faults contractFaults(const SourceFile& file);

/// The users of each folder of methods/kit: methods and `bench`, directly or through other folders of the kit.
[[nodiscard]] std::map<std::string, std::set<std::string>> kitUsers(const std::vector<SourceFile>& files);

/// OpenGL calls, types and headers occur only in methods/kit/gpu.
[[nodiscard]] Faults openGlFaults(const SourceFile& file);

/// At most 400 lines, or a comment `Over 400 lines: why`.
[[nodiscard]] Faults lengthFaults(const SourceFile& file);

/// A header begins with a comment on its purpose.
[[nodiscard]] Faults purposeFaults(const SourceFile& file);

/// `Source: Key, Eq. 1; Key2, ch. 2` in a comment (a second key ends in its year), and the `source = "Key, 1.2"` of a
/// method or part, name an entry of the bibliography.
[[nodiscard]] Faults citationFaults(const SourceFile& file, const std::set<std::string>& keys);

/// The keys of a BibTeX file: `@article{Key,`.
[[nodiscard]] std::set<std::string> bibliographyKeys(std::string_view bibtex);

/// The names and shell patterns (`scenes/*.toml`) in backquotes on a Markdown page.
[[nodiscard]] std::vector<std::string> quotedNames(std::string_view markdown);

/// True if one of the names equals the path or is a pattern that matches it; '*' does not match '/'.
[[nodiscard]] bool isNamed(const std::string& path, const std::vector<std::string>& names);

/// The text with comments and the contents of string and character literals blanked; lines stay where they are.
[[nodiscard]] std::string codeOnly(std::string_view text);

// --- Names in unnamed namespaces. The build compiles files of a module together
// (reports/decisions/0019-joined-files.md): a type of the same name is an error there, and a function may silently
// become an overload of the other file's.

struct OwnName {
    std::string name;
    std::string space;  ///< the named namespace around the unnamed one
    std::size_t line;   ///< from 1
};

/// The declarations of a file in unnamed namespaces, as laid out by `make format`, except members, tests and `using`s
/// of other names.
[[nodiscard]] std::vector<OwnName> ownNames(std::string_view text);

/// Names that two files of a folder (with its `parts/`) declare in this way; module, tests and benchmarks separately.
[[nodiscard]] Faults sharedNameFaults(const std::vector<SourceFile>& files);

}  // namespace dustbench::architecture
