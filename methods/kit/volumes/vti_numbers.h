// The numbers of one array of a VTK file: text, base64 or raw bytes, whole or in compressed blocks.
//
// Binary data begin with words of 4 or 8 bytes. Uncompressed: the number of bytes, then the bytes. Compressed: the
// number of blocks n, the decompressed size of a block and of the last block (0: as the others), n compressed sizes,
// and then the blocks. In base64, an uncompressed array is one unit; the words of a compressed one are a separate unit.
// Every length is checked before memory is allocated. Source: Kitware2021, "XML file formats". Departs:
// no LZMA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace dustbench::volumes {

/// Numbers of an array per point or cell.
inline constexpr std::int64_t maximumComponents = 64;

struct NumberType {
    std::string_view name;  ///< `Float32`
    std::size_t bytes = 0;
    enum class Kind { integer, natural, real } kind = Kind::real;
};

/// Null for types that are not numbers of whole bytes.
[[nodiscard]] const NumberType* findNumberType(std::string_view name);

enum class Compressor { none, zlib, lz4 };

/// Properties of all arrays of a file, from its root element.
struct BinaryForm {
    bool isBigEndian = false;
    std::size_t wordBytes = 4;
    Compressor compressor = Compressor::none;
};

/// Position and format of an array.
struct StoredNumbers {
    const NumberType* type = nullptr;
    std::size_t count = 0;
    enum class Form { ascii, base64, raw } form = Form::ascii;
    std::string_view text;   ///< from its start
    bool endsThere = false;  ///< nothing may follow it
};

/// All numbers, in order. Throws VolumeFault if their count differs.
template <typename Number>  // float or double
[[nodiscard]] std::vector<Number> readNumbers(const StoredNumbers& stored, const BinaryForm& form);

/// The same, piece by piece; a piece is valid during the call only.
void streamNumbers(const StoredNumbers& stored, const BinaryForm& form,
                   const std::function<void(std::span<const float>)>& take);

}  // namespace dustbench::volumes
