// Colour and opacity along Bézier curves of 2 to 8 control points, from birth to death: each channel has a separate
// curve through the components of the points.
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/maths/bezier.h"
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::colour::bezier_points {
namespace {

constexpr int maximumPoints = 8;
constexpr std::array<std::string_view, 4> channelNames{"red", "green", "blue", "opacity"};
constexpr double maximumOpacity = 0.999;

std::string nameOf(int point, std::string_view channel) {
    return "point_" + std::to_string(point + 1) + "." + std::string(channel);
}

class PointsColour final : public ColourPart {
 public:
    explicit PointsColour(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    std::array<std::vector<float>, 4> weights_;  ///< maths::bernsteinWeights, by channel
};

PointsColour::PointsColour(const ParameterValues& values) : ColourPart(values) {
    const auto count = static_cast<int>(values.integer("points"));
    for (std::size_t channel = 0; channel < weights_.size(); ++channel) {
        std::vector<float> points;
        points.reserve(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            points.push_back(static_cast<float>(values.real(nameOf(i, channelNames[channel]))));
        weights_[channel] = maths::bernsteinWeights(points);
    }
}

void writeChannel(std::span<const float> weights, std::size_t count, const float* __restrict share,
                  float* __restrict channel) {
    // Rounding may make a curve that ends at 0 slightly negative.
    for (std::size_t i = 0; i < count; ++i) {
        const float value = maths::bernsteinSum(weights, share[i]);
        channel[i] = value > 0.0f ? value : 0.0f;
    }
}

void PointsColour::update(Chunk& chunk, const Step&) const {
    writeChannel(weights_[0], chunk.count, chunk.share, chunk.red);
    writeChannel(weights_[1], chunk.count, chunk.share, chunk.green);
    writeChannel(weights_[2], chunk.count, chunk.share, chunk.blue);
    writeChannel(weights_[3], chunk.count, chunk.share, chunk.opacity);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "along curves of 2 to 8 control points, one for each channel";
    info.source = "Thesis, 4.4.3; Farin2002, ch. 5";
    info.parameters.integer("points", 6, 2, maximumPoints, "", "number of control points used");
    for (int i = 0; i < maximumPoints; ++i)
        for (const std::string_view channel : channelNames) {
            const bool isOpacity = channel == "opacity";
            info.parameters.real(nameOf(i, channel), isOpacity ? 0.25 : 1, 0, isOpacity ? maximumOpacity : 100, "",
                                 i == 0 ? "linear RGB and peak opacity at birth"
                                        : "linear RGB and peak opacity; the last point used applies at death");
        }
    info.create = [](const ParameterValues& values) { return std::make_unique<PointsColour>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::colour::bezier_points
