#include "bench/suite/bundle/tar_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <numeric>
#include <set>

#include "bench/results/output_files.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::suite {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t blockBytes = 512;

/// The first block of an entry. Texts end with a zero byte unless they fill their field; numbers are octal.
struct Header {
    std::array<char, 100> name{};
    std::array<char, 8> mode{}, owner{}, group{};
    std::array<char, 12> bytes{}, time{};
    std::array<char, 8> sum{};
    char type = '0';
    std::array<char, 100> link{};
    std::array<char, 6> magic{"ustar"};
    std::array<char, 2> version{'0', '0'};
    std::array<char, 32> ownerName{}, groupName{};
    std::array<char, 8> major{}, minor{};
    std::array<char, 155> folder{};
    std::array<char, 12> rest{};
};
static_assert(sizeof(Header) == blockBytes);

/// Writes octal digits. The last byte of the field stays zero.
template <std::size_t size>
void setNumber(std::array<char, size>& field, std::uintmax_t number) {
    for (std::size_t digit = size - 1; digit-- > 0; number /= 8) field[digit] = static_cast<char>('0' + number % 8);
}

template <std::size_t size>
std::string textIn(const std::array<char, size>& field) {
    return {field.data(), strnlen(field.data(), size)};
}

/// False if the field is not an octal number.
template <std::size_t size>
bool readNumber(const std::array<char, size>& field, std::uintmax_t& number) {
    const std::string text = textIn(field);
    const char* const end = text.data() + text.find_last_not_of(' ') + 1;
    const auto [stop, error] = std::from_chars(text.data(), end, number, 8);
    return error == std::errc() && stop == end;
}

/// Sum of all bytes of the header, with spaces in place of the sum itself.
unsigned sumOf(Header header) {
    header.sum.fill(' ');
    std::array<unsigned char, blockBytes> bytes{};
    std::memcpy(bytes.data(), &header, blockBytes);
    return std::accumulate(bytes.begin(), bytes.end(), 0U);
}

constexpr std::uintmax_t mostBytes = 077777777777;

/// Splits the name at a `/` into parts that fit the two fields.
bool setName(Header& header, const std::string& name) {
    std::size_t slash = std::string::npos;
    if (name.size() > header.name.size()) {
        slash = name.find('/', name.size() - header.name.size() - 1);
        if (slash == std::string::npos || slash > header.folder.size()) return false;
        name.copy(header.folder.data(), slash);
    }
    name.substr(slash + 1).copy(header.name.data(), header.name.size());  // npos + 1 is 0
    return true;
}

std::uintmax_t padding(std::uintmax_t bytes) {
    return (blockBytes - bytes % blockBytes) % blockBytes;
}

/// Reads an archive block by block. Owns: the stream.
class TarReader {
 public:
    TarReader(const fs::path& archive, const fs::path& folder)
        : archive_(archive), folder_(folder), stream_(archive, std::ios::binary) {
        if (!stream_) refuse(std::strerror(errno));
    }

    /// Extracts the next file below the folder and returns its name; empty at the end.
    std::string next() {
        Header header;
        read(reinterpret_cast<char*>(&header), blockBytes);
        if (isZero(header)) return "";
        const std::string name = checkedName(header);
        std::uintmax_t bytes = 0;
        if (!readNumber(header.bytes, bytes)) refuse(fmt::format("the length of '{}' is not a number", name));
        extract(name, bytes);
        return name;
    }

 private:
    [[noreturn]] void refuse(std::string_view reason) const {
        throw InputError(fmt::format("'{}': {}", archive_.string(), reason));
    }
    static bool isZero(const Header& header) {
        const std::array<char, blockBytes> zeros{};
        return std::memcmp(&header, zeros.data(), blockBytes) == 0;
    }
    void read(char* to, std::size_t bytes) {
        if (!stream_.read(to, static_cast<std::streamsize>(bytes))) refuse("is truncated or not a dustbench bundle");
    }
    std::string checkedName(const Header& header) {
        std::uintmax_t sum = 0;
        if (textIn(header.magic) != "ustar" || !readNumber(header.sum, sum) || sum != sumOf(header))
            refuse("is damaged or not a dustbench bundle: invalid entry header");
        const std::string folder = textIn(header.folder);
        std::string name = (folder.empty() ? "" : folder + "/") + textIn(header.name);
        if (header.type != '0') refuse(fmt::format("'{}' is not a regular file", name));
        if (name.empty() || !results::isWithin(name)) refuse(fmt::format("'{}' points outside the bundle", name));
        if (!names_.insert(name).second) refuse(fmt::format("'{}' appears twice", name));
        return name;
    }
    void extract(const std::string& name, std::uintmax_t bytes) {
        const fs::path file = folder_ / name;
        fs::create_directories(file.parent_path());
        errno = 0;
        std::ofstream out(file, std::ios::binary);
        std::array<char, 1 << 16> block{};
        for (std::uintmax_t left = bytes; left > 0;) {
            const auto count = static_cast<std::size_t>(std::min<std::uintmax_t>(left, block.size()));
            read(block.data(), count);
            out.write(block.data(), static_cast<std::streamsize>(count));
            left -= count;
        }
        if (!out.flush()) files::failWriting(file, errno);
        stream_.ignore(static_cast<std::streamsize>(padding(bytes)));
    }

    fs::path archive_, folder_;
    std::ifstream stream_;
    std::set<std::string> names_;
};

}  // namespace

TarWriter::TarWriter(fs::path file) : file_(std::move(file)), stream_(file_, std::ios::binary) {
    if (!stream_) files::failWriting(file_, errno);
}

void TarWriter::write(const char* from, std::size_t bytes) {
    errno = 0;
    if (!stream_.write(from, static_cast<std::streamsize>(bytes))) files::failWriting(file_, errno);
}

void TarWriter::pad(std::uintmax_t bytes) {
    const std::array<char, blockBytes> zeros{};
    write(zeros.data(), static_cast<std::size_t>(padding(bytes)));
}

void TarWriter::header(const std::string& name, std::uintmax_t bytes) {
    Header header;
    if (!setName(header, name)) throw InputError(fmt::format("'{}': the name is too long for an archive", name));
    if (bytes > mostBytes)
        throw InputError(fmt::format("'{}': is {} bytes long, allowed in an archive: {}", name, bytes, mostBytes));
    setNumber(header.mode, 0644);
    setNumber(header.owner, 0);
    setNumber(header.group, 0);
    setNumber(header.bytes, bytes);
    setNumber(header.time, 0);
    setNumber(header.sum, sumOf(header));
    write(reinterpret_cast<const char*>(&header), blockBytes);
}

void TarWriter::add(const std::string& name, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError(fmt::format("'{}': cannot be read: {}", file.string(), std::strerror(errno)));
    const std::uintmax_t bytes = fs::file_size(file);
    header(name, bytes);
    std::array<char, 1 << 16> block{};
    for (std::uintmax_t left = bytes; left > 0;) {
        const auto count = static_cast<std::size_t>(std::min<std::uintmax_t>(left, block.size()));
        if (!in.read(block.data(), static_cast<std::streamsize>(count)))
            throw InputError(fmt::format("'{}': was truncated while it was read", file.string()));
        write(block.data(), count);
        left -= count;
    }
    pad(bytes);
}

void TarWriter::addText(const std::string& name, std::string_view text) {
    header(name, text.size());
    write(text.data(), text.size());
    pad(text.size());
}

void TarWriter::finish() {
    const std::array<char, 2 * blockBytes> zeros{};
    write(zeros.data(), zeros.size());
    errno = 0;
    if (!stream_.flush()) files::failWriting(file_, errno);
    stream_.close();
}

std::vector<std::string> extractTar(const fs::path& archive, const fs::path& folder) {
    TarReader reader(archive, folder);
    std::vector<std::string> names;
    for (std::string name = reader.next(); !name.empty(); name = reader.next()) names.push_back(std::move(name));
    return names;
}

}  // namespace dustbench::suite
