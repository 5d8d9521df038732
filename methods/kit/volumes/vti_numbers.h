// The numbers of one array of a VTK file: text, base64 or raw bytes, whole or in compressed blocks.
//
// Binary data begin with words of 4 or 8 bytes. Uncompressed: the number of bytes, then these. Compressed: the number
// of blocks n, the bytes of a block and of the last one (0: as the others) once decompressed, then n lengths; the
// blocks follow. In base64 a whole uncompressed array is one unit, a compressed one has its words in a unit of their
// own. Everything is held to its length before memory is allocated. Source: Kitware2021, "XML file formats". Departs:
// no LZMA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace dustbench::volumes {

/// Of an array: numbers of one point or cell.
inline constexpr std::int64_t maximumComponents = 64;

struct NumberType {
    std::string_view name;  ///< `Float32`
    std::size_t bytes = 0;
    enum class Kind { integer, natural, real } kind = Kind::real;
};

/// Null if these are no numbers of whole bytes.
[[nodiscard]] const NumberType* findNumberType(std::string_view name);

enum class Compressor { none, zlib, lz4 };

/// What the root of a file says of all its arrays.
struct BinaryForm {
    bool isBigEndian = false;
    std::size_t wordBytes = 4;
    Compressor compressor = Compressor::none;
};

/// Where an array is, and how.
struct StoredNumbers {
    const NumberType* type = nullptr;
    std::size_t count = 0;
    enum class Form { ascii, base64, raw } form = Form::ascii;
    std::string_view text;   ///< from its beginning on
    bool endsThere = false;  ///< no byte may follow it
};

/// All numbers, in order. Throws VolumeFault unless there are exactly as many.
template <typename Number>  // float or double
[[nodiscard]] std::vector<Number> readNumbers(const StoredNumbers& stored, const BinaryForm& form);

/// The same, a piece after the other, none of which lasts.
void streamNumbers(const StoredNumbers& stored, const BinaryForm& form,
                   const std::function<void(std::span<const float>)>& take);

}  // namespace dustbench::volumes
