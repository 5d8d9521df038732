#include "bench/scene/relief_file.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/pictures/picture_files.h"

namespace dustbench::bench {
namespace {

constexpr int minimumTexels = 2, maximumTexels = files::limits::heightEdge;

std::string sizeOf(const pictures::StoredPicture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

/// Checks the size before any pixel is read: a picture that is too large may not fit into memory.
void requireSize(const std::filesystem::path& file) {
    pictures::StoredPicture picture;
    if (const std::string reason = pictures::readPictureSize(file, picture); !reason.empty())
        throw InputError(file.string() + ": not an image that can be read: " + reason);
    if (std::min(picture.width, picture.height) < minimumTexels ||
        std::max(picture.width, picture.height) > maximumTexels)
        throw InputError(file.string() + ": has " + sizeOf(picture) + " texels, allowed: 2.." +
                         std::to_string(maximumTexels) + " a side");
}

pictures::StoredPicture readPicture(const std::filesystem::path& file) {
    requireSize(file);
    pictures::StoredPicture picture;
    if (const std::string reason = pictures::readPicture(file, picture); !reason.empty())
        throw InputError(file.string() + ": not an image that can be read: " + reason);
    return picture;
}

/// Calls `visit(texel, value)` for the pixels from the bottom row up, the order of a relief.
template <typename Visit>
void forEachTexel(const pictures::StoredPicture& picture, const Visit& visit) {
    const auto columns = static_cast<std::size_t>(picture.width), rows = static_cast<std::size_t>(picture.height);
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            visit(row * columns + column, &picture.values[((rows - 1 - row) * columns + column) * channels]);
}

void readDepths(const std::filesystem::path& file, scene::Relief& relief) {
    const pictures::StoredPicture heights = readPicture(file);
    files::noteIgnored(file, pictures::unusedParts(heights, 1, false));
    relief.columns = heights.width;
    relief.rows = heights.height;
    relief.depth.resize(static_cast<std::size_t>(heights.width) * static_cast<std::size_t>(heights.height));
    forEachTexel(heights, [&](std::size_t texel, const float* value) {
        if (!(value[0] >= 0 && value[0] <= 1))
            throw InputError(file.string() + ": a height is " + std::to_string(value[0]) + ", allowed: 0..1");
        relief.depth[texel] = 1 - value[0];
    });
}

void readColours(const std::filesystem::path& file, scene::Relief& relief) {
    const pictures::StoredPicture colours = readPicture(file);
    if (const std::string reason = colours.encoding.refusal(); !reason.empty())
        throw InputError(file.string() + ": " + reason);
    if (colours.width != relief.columns || colours.height != relief.rows)
        throw InputError(file.string() + ": the colours have " + sizeOf(colours) + " texels, expected those of the " +
                         "heights, " + std::to_string(relief.columns) + "x" + std::to_string(relief.rows));
    files::noteIgnored(file, pictures::unusedParts(colours, colours.channels >= 3 ? 3 : 1, false));
    const auto green = static_cast<std::size_t>(colours.channels >= 3 ? 1 : 0), blue = 2 * green;
    forEachTexel(colours, [&](std::size_t texel, const float* value) {
        const glm::vec3 stored(value[0], value[green], value[blue]);
        for (int i = 0; i < 3; ++i)
            if (!(stored[i] >= 0 && stored[i] <= 1))
                throw InputError(file.string() + ": a colour is " + std::to_string(stored[i]) + ", allowed: 0..1");
        for (int i = 0; i < 3; ++i) relief.colour[texel][i] = colours.encoding.decoded(stored[i]);
    });
}

}  // namespace

ReliefFile readRelief(const std::filesystem::path& file) {
    files::TomlReader root = files::TomlReader::parseFile(file);
    ReliefFile result;
    result.files.push_back(file);
    result.description = root.text("description");
    const std::filesystem::path folder = file.parent_path();
    const auto relief = std::make_shared<scene::Relief>();

    const std::filesystem::path heights = folder / root.text("heights");
    result.files.push_back(heights);
    readDepths(heights, *relief);

    const glm::dvec3 colour = root.vector3("colour", glm::dvec3(0.5));
    for (int i = 0; i < 3; ++i)
        if (!(colour[i] >= 0 && colour[i] <= 1))
            throw InputError(root.where("colour") + "key 'colour': expected a linear RGB colour, each 0..1");
    relief->colour.assign(relief->depth.size(), glm::vec3(colour));
    if (root.has("colours")) {
        const std::filesystem::path colours = folder / root.text("colours");
        result.files.push_back(colours);
        readColours(colours, *relief);
    }
    root.finish();
    result.relief = relief;
    return result;
}

}  // namespace dustbench::bench
