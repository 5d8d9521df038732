#include "methods/kit/files/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::files {
namespace {

/// Reads records of RFC 4180: quoted cells may hold commas, line ends and doubled quotes.
class Records {
 public:
    Records(std::string_view text, const std::string& name) : text_(text), name_(name) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }

    /// Reads the next non-blank record; false at the end.
    bool next(std::vector<std::string>& cells, std::size_t& line) {
        do {
            if (at_ >= text_.size()) return false;
            cells.clear();
            line = line_;
            readRecord(cells);
        } while (cells.size() == 1 && cells.front().empty());
        return true;
    }

 private:
    void readRecord(std::vector<std::string>& cells) {
        for (;;) {
            cells.push_back(at_ < text_.size() && text_[at_] == '"' ? readQuoted() : readPlain());
            if (at_ >= text_.size()) return;
            const char end = text_[at_++];
            if (end == ',') continue;
            if (end == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
            ++line_;
            return;
        }
    }

    std::string readPlain() {
        const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
        std::string cell(text_.substr(at_, end - at_));
        at_ = end;
        return cell;
    }

    std::string readQuoted() {
        const std::size_t first = line_;
        std::string cell;
        for (++at_; at_ < text_.size(); ++at_) {
            if (text_[at_] == '"') {
                if (++at_ < text_.size() && text_[at_] == '"') {
                    cell += '"';
                    continue;
                }
                if (at_ < text_.size() && text_.find_first_of(",\r\n", at_) != at_)
                    throw InputError(name_ + ":" + std::to_string(line_) +
                                     ": text after a closing quote, expected a comma or the line's end");
                return cell;
            }
            if (text_[at_] == '\n') ++line_;
            cell += text_[at_];
        }
        throw InputError(name_ + ":" + std::to_string(first) + ": a quote is not closed");
    }

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::size_t line_ = 1;
};

}  // namespace

CsvTable CsvTable::parseText(std::string_view text, std::string name) {
    CsvTable table;
    table.name_ = std::move(name);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw InputError(table.name_ + ": the file is in UTF-16, expected UTF-8");
    Records records(text, table.name_);
    std::size_t line = 0;
    if (!records.next(table.header_, line))
        throw InputError(table.name_ + ":1: the file is empty, expected a header line");
    if (table.header_.size() == 1)
        for (const auto& [separator, word] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")})
            if (table.header_.front().find(separator) != std::string::npos)
                throw InputError(table.name_ + ":1: cells are separated by " + word +
                                 ", expected commas, and decimal points in numbers (1.5, not 1,5)");
    std::vector<std::string> cells;
    while (records.next(cells, line)) {
        if (cells.size() != table.header_.size())
            throw InputError(table.name_ + ":" + std::to_string(line) + ": got " + std::to_string(cells.size()) +
                             " cells, expected " + std::to_string(table.header_.size()) + " as in the header");
        table.cells_.push_back(cells);
        table.lines_.push_back(line);
    }
    return table;
}

CsvTable CsvTable::parseFile(const std::filesystem::path& file) {
    const std::string text = wholeText(file, "a CSV file");
    noteInput(file);
    return parseText(text, file.string());
}

bool CsvTable::hasColumn(std::string_view column) const {
    return std::ranges::find(header_, column) != header_.end();
}

std::size_t CsvTable::columnIndex(std::string_view column) const {
    const auto found = std::ranges::find(header_, column);
    if (found == header_.end()) throw InputError(name_ + ":1: column '" + std::string(column) + "' is missing");
    return static_cast<std::size_t>(found - header_.begin());
}

const std::string& CsvTable::cell(std::size_t row, std::string_view column) const {
    return cells_.at(row)[columnIndex(column)];
}

double CsvTable::number(std::size_t row, std::string_view column) const {
    const std::string& text = cell(row, column);
    const std::optional<double> value = numberOf(text);
    if (!value)
        throw InputError(where(row) + "column '" + std::string(column) + "': got '" + text + "', expected a number");
    return *value;
}

std::string CsvTable::where(std::size_t row) const {
    return name_ + ":" + std::to_string(lines_.at(row)) + ": ";
}

std::optional<double> numberOf(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string csvCell(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string csvNumber(double value) {
    if (!std::isfinite(value)) return "";
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

}  // namespace dustbench::files
