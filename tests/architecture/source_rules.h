// The rules that every source file of the project keeps, as functions of a file's path and text.
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

/// What breaks a rule, one `path:line: what is wrong` each.
using Faults = std::vector<std::string>;

/// Includes point one way: methods/<id> → methods/kit → methods/contract ← bench, and within bench/ from later rooms to
/// earlier ones; nothing is included by a path that climbs.
[[nodiscard]] Faults includeFaults(const SourceFile& file);

/// A header of methods/contract includes the standard library, GLM and its like alone.
[[nodiscard]] Faults contractFaults(const SourceFile& file);

/// Who uses each folder of methods/kit: methods and `bench`, directly or through other folders of the kit.
[[nodiscard]] std::map<std::string, std::set<std::string>> kitUsers(const std::vector<SourceFile>& files);

/// OpenGL is called, and its types and headers are seen, in methods/kit/gpu alone.
[[nodiscard]] Faults openGlFaults(const SourceFile& file);

/// At most 400 lines, or a comment `Over 400 lines: why`.
[[nodiscard]] Faults lengthFaults(const SourceFile& file);

/// A header begins with a comment that says what it is for.
[[nodiscard]] Faults purposeFaults(const SourceFile& file);

/// `Source: Key, Eq. 1; Key2, ch. 2` in a comment (a second key ends in its year), and the `source = "Key, 1.2"` of a
/// method or part, name an entry of the bibliography.
[[nodiscard]] Faults citationFaults(const SourceFile& file, const std::set<std::string>& keys);

/// The keys of a BibTeX file: `@article{Key,`.
[[nodiscard]] std::set<std::string> bibliographyKeys(std::string_view bibtex);

/// The names and shell patterns (`scenes/*.toml`) that a Markdown page sets in backquotes.
[[nodiscard]] std::vector<std::string> quotedNames(std::string_view markdown);

/// True where one of the names is the path, or a pattern of it in which '*' stays within one folder.
[[nodiscard]] bool isNamed(const std::string& path, const std::vector<std::string>& names);

/// The text with comments and the contents of string and character literals blanked; lines stay where they are.
[[nodiscard]] std::string codeOnly(std::string_view text);

}  // namespace dustbench::architecture
