// EXR files, through OpenEXR; floats are written losslessly.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include "methods/kit/pictures/picture_files.h"

namespace dustbench::pictures {

std::string writeExr(const std::filesystem::path& file, int width, int height, std::span<const float> values) {
    constexpr std::size_t pixelBytes = 4 * sizeof(float);
    try {
        Imf::Header header(width, height);
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::FrameBuffer channels;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const std::string name(1, "RGBA"[channel]);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            auto* const first = reinterpret_cast<char*>(const_cast<float*>(&values[channel]));
            channels.insert(name,
                            Imf::Slice(Imf::FLOAT, first, pixelBytes, pixelBytes * static_cast<std::size_t>(width)));
        }
        Imf::OutputFile output(file.c_str(), header);
        output.setFrameBuffer(channels);
        output.writePixels(height);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace dustbench::pictures
