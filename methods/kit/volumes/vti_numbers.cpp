#include "methods/kit/volumes/vti_numbers.h"

#include <fmt/format.h>
#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "methods/kit/volumes/xml_scan.h"

namespace dustbench::volumes {
namespace {

using Kind = NumberType::Kind;

[[noreturn]] void failShort() {
    throw VolumeFault{"an array is shorter than its extent"};
}

[[noreturn]] void failDamaged() {
    throw VolumeFault{"an array's compressed data are damaged"};
}

// Text.

[[noreturn]] void failNumber(std::string_view word, const NumberType& type) {
    throw VolumeFault{fmt::format("an array of {} contains '{}'", type.name, word.substr(0, 40))};
}

/// Parses the whole word. A value too small for the type becomes 0; one too large for it is not a number.
template <typename Real>
Real realOf(std::string_view word, const NumberType& type) {
    Real value = 0;
    const auto [at, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (at != word.data() + word.size()) failNumber(word, type);
    if (error == std::errc()) return value;
    if (error != std::errc::result_out_of_range || std::isinf(std::strtod(std::string(word).c_str(), nullptr)))
        failNumber(word, type);
    value = static_cast<Real>(std::strtod(std::string(word).c_str(), nullptr));
    if (std::isinf(value)) failNumber(word, type);
    return value;
}

double parsed(std::string_view word, const NumberType& type) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (type.kind == Kind::real && type.bytes == sizeof(float)) return static_cast<double>(realOf<float>(word, type));
    const auto value = realOf<double>(word, type);
    if (type.kind != Kind::real && (value != std::floor(value) || std::abs(value) > 9e18)) failNumber(word, type);
    return value;
}

/// Passes numbers on to their receiver.
class Stream {
 public:
    using value_type = float;
    explicit Stream(const std::function<void(std::span<const float>)>& take) : take_(take) { piece_.reserve(atOnce); }

    void reserve(std::size_t) {}
    void push_back(float number) {
        piece_.push_back(number);
        ++size_;
        if (piece_.size() == atOnce) flush();
    }
    void flush() {
        if (!piece_.empty()) take_(piece_);
        piece_.clear();
    }
    [[nodiscard]] std::size_t size() const { return size_; }

 private:
    static constexpr std::size_t atOnce = 1 << 16;
    const std::function<void(std::span<const float>)>& take_;
    std::vector<float> piece_;
    std::size_t size_ = 0;
};

/// `Numbers`, here and below: a vector of floats or doubles, or a Stream.
template <typename Numbers>
void readText(const StoredNumbers& stored, Numbers& numbers) {
    std::string_view rest = trimmed(stored.text);
    if (rest.size() / 2 + 1 < stored.count) failShort();
    numbers.reserve(stored.count);
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
        if (numbers.size() == stored.count) throw VolumeFault{"an array is longer than its extent"};
        numbers.push_back(static_cast<typename Numbers::value_type>(parsed(rest.substr(0, end), *stored.type)));
        rest = trimmed(rest.substr(end));
    }
    if (numbers.size() < stored.count) failShort();
}

// Bytes.

constexpr std::array<std::int8_t, 256> sixBits = [] {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
    return values;
}();

/// The first `count` bytes of a base64 unit, which must contain as many.
std::string decoded(std::string_view text, std::size_t count) {
    std::string bytes;
    bytes.reserve(count + 2);
    for (std::size_t at = 0; bytes.size() < count; at += 4) {
        std::uint32_t bits = 0;
        const std::size_t wanted = std::min<std::size_t>(count - bytes.size(), 3);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::int8_t six = sixBits[static_cast<unsigned char>(text[at + i])];
            if (six < 0 && i <= wanted) throw VolumeFault{"an array is not in base64"};
            bits = bits << 6 | static_cast<std::uint32_t>(std::max<std::int8_t>(six, 0));
        }
        for (std::size_t i = 0; i < wanted; ++i) bytes += static_cast<char>(bits >> (16 - 8 * i) & 0xff);
    }
    return bytes;
}

/// Reads consecutive units of bytes.
class ByteSource {
 public:
    explicit ByteSource(const StoredNumbers& stored)
        : rest_(stored.text), isBase64_(stored.form == StoredNumbers::Form::base64) {}

    /// Maximum number of bytes in the next unit.
    [[nodiscard]] std::size_t available() const { return isBase64_ ? rest_.size() / 4 * 3 : rest_.size(); }
    /// The start of the next unit.
    [[nodiscard]] std::string peek(std::size_t count) const {
        if (count > available()) throw VolumeFault{"an array extends beyond the end of its data"};
        return isBase64_ ? decoded(rest_, count) : std::string(rest_.substr(0, count));
    }
    /// The next unit, of this many bytes.
    [[nodiscard]] std::string take(std::size_t count) {
        std::string bytes = peek(count);
        const std::size_t padding = isBase64_ ? (3 - count % 3) % 3 : 0;
        const std::size_t length = isBase64_ ? (count + padding) / 3 * 4 : count;
        if (rest_.substr(length - padding, padding) != std::string_view("==").substr(0, padding))
            throw VolumeFault{"an array is not in base64"};
        rest_.remove_prefix(length);
        return bytes;
    }
    [[nodiscard]] bool isAtEnd() const { return rest_.empty(); }

 private:
    std::string_view rest_;
    bool isBase64_;
};

static_assert(std::endian::native == std::endian::little);

/// One to eight bytes as a natural number.
std::uint64_t naturalOf(std::string_view bytes, bool isBigEndian) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data(), bytes.size());
    return isBigEndian ? __builtin_bswap64(value) >> (64 - 8 * bytes.size()) : value;
}

std::uint64_t wordOf(std::string_view words, std::size_t index, const BinaryForm& form) {
    return naturalOf(words.substr(index * form.wordBytes, form.wordBytes), form.isBigEndian);
}

double numberOf(std::string_view bytes, const NumberType& type, bool isBigEndian) {
    const std::uint64_t bits = naturalOf(bytes, isBigEndian);
    if (type.kind == Kind::natural) return static_cast<double>(bits);
    const std::size_t unused = 64 - 8 * type.bytes;
    if (type.kind == Kind::integer)
        return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);  // with its sign
    if (type.bytes == sizeof(double)) return std::bit_cast<double>(bits);
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

template <typename Numbers>
void append(Numbers& numbers, std::string_view bytes, const NumberType& type, bool isBigEndian) {
    for (; !bytes.empty(); bytes.remove_prefix(type.bytes))
        numbers.push_back(
            static_cast<typename Numbers::value_type>(numberOf(bytes.substr(0, type.bytes), type, isBigEndian)));
}

// Blocks.

struct Blocks {
    std::size_t blockBytes = 0, lastBytes = 0;
    std::vector<std::size_t> lengths;  ///< compressed bytes of each
    std::size_t total = 0;             ///< sum of `lengths`

    [[nodiscard]] std::size_t bytesOf(std::size_t block) const {
        return block + 1 == lengths.size() && lastBytes > 0 ? lastBytes : blockBytes;
    }
};

/// The highest ratio of either compressor is zlib's, 1032.
constexpr std::size_t maximumRatio = 1040;

/// Reads the words before the blocks, whose contents must have `bytes` bytes together.
Blocks readBlocks(ByteSource& source, std::size_t bytes, const StoredNumbers& stored, const BinaryForm& form) {
    const std::string start = source.peek(3 * form.wordBytes);
    const std::uint64_t count = wordOf(start, 0, form), blockBytes = wordOf(start, 1, form),
                        lastBytes = wordOf(start, 2, form);
    if (count < 1 || count > source.available() / form.wordBytes || blockBytes < 1 ||
        blockBytes > std::size_t{LZ4_MAX_INPUT_SIZE} || lastBytes > blockBytes)
        failDamaged();
    const std::uint64_t all = (count - 1) * blockBytes + (lastBytes > 0 ? lastBytes : blockBytes);
    if (all != bytes) throw VolumeFault{fmt::format("an array has {} bytes, expected {} by its extent", all, bytes)};
    if (count > 1 && blockBytes % stored.type->bytes != 0) failDamaged();
    Blocks blocks{static_cast<std::size_t>(blockBytes), static_cast<std::size_t>(lastBytes), {}, 0};
    const std::string words = source.take((3 + static_cast<std::size_t>(count)) * form.wordBytes);
    for (std::size_t i = 3; i < 3 + count; ++i) {
        const std::uint64_t length = wordOf(words, i, form);
        if (length < 1 || length > source.available() || length > std::size_t{LZ4_MAX_INPUT_SIZE}) failDamaged();
        blocks.lengths.push_back(static_cast<std::size_t>(length));
        blocks.total += blocks.lengths.back();
    }
    if (blocks.total > source.available() || bytes / maximumRatio > blocks.total) failDamaged();
    return blocks;
}

void decompress(std::string_view from, std::string& to, Compressor compressor) {
    if (compressor == Compressor::lz4) {
        const int got =
            LZ4_decompress_safe(from.data(), to.data(), static_cast<int>(from.size()), static_cast<int>(to.size()));
        if (got < 0 || static_cast<std::size_t>(got) != to.size()) failDamaged();
        return;
    }
    uLongf got = to.size();
    const int result =
        uncompress(reinterpret_cast<Bytef*>(to.data()), &got, reinterpret_cast<const Bytef*>(from.data()), from.size());
    if (result != Z_OK || got != to.size()) failDamaged();
}

template <typename Numbers>
void readCompressed(ByteSource& source, const StoredNumbers& stored, const BinaryForm& form, Numbers& numbers) {
    const Blocks blocks = readBlocks(source, stored.count * stored.type->bytes, stored, form);
    const std::string compressed = source.take(blocks.total);
    numbers.reserve(stored.count);
    std::string block;
    std::size_t at = 0;
    for (std::size_t i = 0; i < blocks.lengths.size(); ++i) {
        block.resize(blocks.bytesOf(i));
        decompress(std::string_view(compressed).substr(at, blocks.lengths[i]), block, form.compressor);
        append(numbers, block, *stored.type, form.isBigEndian);
        at += blocks.lengths[i];
    }
}

template <typename Numbers>
void readUncompressed(ByteSource& source, const StoredNumbers& stored, const BinaryForm& form, Numbers& numbers) {
    const std::size_t bytes = stored.count * stored.type->bytes;
    const std::uint64_t said = wordOf(source.peek(form.wordBytes), 0, form);
    if (said != bytes) throw VolumeFault{fmt::format("an array has {} bytes, expected {} by its extent", said, bytes)};
    if (form.wordBytes + bytes > source.available()) failShort();
    const std::string unit = source.take(form.wordBytes + bytes);
    numbers.reserve(stored.count);
    append(numbers, std::string_view(unit).substr(form.wordBytes), *stored.type, form.isBigEndian);
}

template <typename Numbers>
void readInto(Numbers& numbers, const StoredNumbers& stored, const BinaryForm& form) {
    if (stored.form == StoredNumbers::Form::ascii) return readText(stored, numbers);
    ByteSource source(stored);
    if (form.compressor == Compressor::none)
        readUncompressed(source, stored, form, numbers);
    else
        readCompressed(source, stored, form, numbers);
    if (stored.endsThere && !source.isAtEnd()) throw VolumeFault{"an array is longer than its extent"};
}

}  // namespace

const NumberType* findNumberType(std::string_view name) {
    static constexpr std::array<NumberType, 10> types{{{"Int8", 1, Kind::integer},
                                                       {"UInt8", 1, Kind::natural},
                                                       {"Int16", 2, Kind::integer},
                                                       {"UInt16", 2, Kind::natural},
                                                       {"Int32", 4, Kind::integer},
                                                       {"UInt32", 4, Kind::natural},
                                                       {"Int64", 8, Kind::integer},
                                                       {"UInt64", 8, Kind::natural},
                                                       {"Float32", 4, Kind::real},
                                                       {"Float64", 8, Kind::real}}};
    const auto* const found = std::ranges::find(types, name, &NumberType::name);
    return found == types.end() ? nullptr : found;
}

template <typename Number>
std::vector<Number> readNumbers(const StoredNumbers& stored, const BinaryForm& form) {
    std::vector<Number> numbers;
    readInto(numbers, stored, form);
    return numbers;
}

void streamNumbers(const StoredNumbers& stored, const BinaryForm& form,
                   const std::function<void(std::span<const float>)>& take) {
    Stream numbers(take);
    readInto(numbers, stored, form);
    numbers.flush();
}

template std::vector<float> readNumbers<float>(const StoredNumbers&, const BinaryForm&);
template std::vector<double> readNumbers<double>(const StoredNumbers&, const BinaryForm&);

}  // namespace dustbench::volumes
