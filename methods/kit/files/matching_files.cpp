#include "methods/kit/files/matching_files.h"

#include <fnmatch.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"

namespace dustbench::files {
namespace fs = std::filesystem;
namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

/// Takes the digits from the front of the text, without leading zeros.
std::string_view takeDigits(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
    std::string_view digits = text.substr(0, end);
    text.remove_prefix(end);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

/// Orders by name, with runs of digits as numbers. Names that differ only in leading zeros are compared as text.
bool isBefore(const fs::path& a, const fs::path& b) {
    const std::string nameA = a.filename().string(), nameB = b.filename().string();
    std::string_view restA = nameA, restB = nameB;
    while (!restA.empty() && !restB.empty()) {
        if (isDigit(restA.front()) && isDigit(restB.front())) {
            const std::string_view numberA = takeDigits(restA), numberB = takeDigits(restB);
            if (numberA.size() != numberB.size()) return numberA.size() < numberB.size();
            if (numberA != numberB) return numberA < numberB;
        } else {
            if (restA.front() != restB.front()) return restA.front() < restB.front();
            restA.remove_prefix(1);
            restB.remove_prefix(1);
        }
    }
    return restA.size() != restB.size() ? restA.size() < restB.size() : nameA < nameB;
}

}  // namespace

bool isPattern(const fs::path& path) {
    return path.filename().string().find('*') != std::string::npos;
}

std::vector<fs::path> foundFiles(const fs::path& path) {
    const std::string name = path.filename().string();
    std::vector<fs::path> found;
    std::error_code error;
    if (!isPattern(path)) {
        if (fs::is_regular_file(path, error)) found.push_back(path);
        return found;
    }
    for (const auto& entry : fs::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", error))
        if (fnmatch(name.c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0) found.push_back(entry.path());
    std::ranges::sort(found, isBefore);
    return found;
}

std::string unevenStep(const std::vector<fs::path>& files) {
    std::vector<std::vector<double>> numbers;  // per name
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        std::vector<double>& ofName = numbers.emplace_back();
        for (std::string_view rest = name; !rest.empty();)
            if (isDigit(rest.front()))
                ofName.push_back(numberOf(takeDigits(rest)).value_or(0));
            else
                rest.remove_prefix(1);
        if (ofName.size() != numbers.front().size()) return "";
    }
    std::vector<double> counted;
    for (std::size_t place = 0; !files.empty() && place < numbers.front().size(); ++place) {
        std::vector<double> column;
        column.reserve(numbers.size());
        for (const std::vector<double>& ofName : numbers) column.push_back(ofName[place]);
        if (std::ranges::all_of(column, [&column](double number) { return number == column.front(); })) continue;
        if (!counted.empty()) return "";  // more than one number changes
        counted = std::move(column);
    }
    for (std::size_t i = 2; i < counted.size(); ++i)
        if (counted[i] - counted[i - 1] != counted[1] - counted[0])
            return "the numbers in the names step by " + csvNumber(counted[1] - counted[0]) + ", and by " +
                   csvNumber(counted[i] - counted[i - 1]) + " from '" + files[i - 1].filename().string() + "' to '" +
                   files[i].filename().string() + "'";
    return "";
}

std::vector<fs::path> matchingFiles(const fs::path& pattern) {
    std::vector<fs::path> found = foundFiles(pattern);
    std::error_code error;
    if (found.empty() || !fs::is_regular_file(found.front(), error))
        throw InputError(pattern.string() + ": no such file" + (isPattern(pattern) ? "" : didYouMean(pattern)));
    if (isPattern(pattern)) noteSearch(pattern);
    for (const fs::path& file : found) noteInput(file);
    return found;
}

}  // namespace dustbench::files
