#include "methods/kit/draw/ground_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <string>

#include "draw_shaders.h"
#include "methods/kit/draw/opaque_moment.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {
namespace {

/// Packed ground is darker than the dust that comes off it.
constexpr float packedShare = 0.52f;

/// Half the width of the strip with the track's ruts, and the cuts along its length, which keep each triangle's depth
/// range short.
constexpr float trackHalfWidthMetres = 2.7f;
constexpr std::array<float, 13> trackCutsMetres{-4096, -1024, -256, -64, -16, -4, 0, 4, 16, 64, 256, 1024, 4096};

bool hasTrack(const scene::Scene& scene) {
    return scene.terrain.isFlat() && scene.vehicle;
}

std::map<std::string, std::string> groundDefinitions(const scene::Scene& scene, bool lamps, bool track, bool shaded) {
    std::map<std::string, std::string> result = opaqueDefinitions(scene, lamps);
    result.insert({
        {"DETAIL_TILES", std::to_string(patchTileMetres / detailTileMetres)},
        {"TILES_PER_METRE", std::to_string(1 / patchTileMetres)},
        {"PATCH_SCALE", std::to_string(255.0 / 128)},
    });
    if (!scene.terrain.isFlat()) result.emplace("RELIEF", "1");
    if (track) result.emplace("TRACK", "1");
    if (shaded) result.emplace("SHADED", "1");
    return result;
}

gpu::Program groundProgram(gpu::Device& device, std::string_view label, const scene::Scene& scene, bool lamps,
                           bool track, bool shaded) {
    using namespace draw_shaders;
    return {device,
            label,
            {opaque_moment_glsl, opaque_shadow_glsl, error_function_glsl, opaque_dust_glsl, opaque_lamps_glsl,
             opaque_ground_vert, opaque_ground_frag},
            groundDefinitions(scene, lamps, track, shaded)};
}

gpu::VertexArray layoutOf(gpu::Device& device, const gpu::Buffer& vertices) {
    gpu::VertexArray layout(device);
    layout.attribute(0, 3, vertices, sizeof(GroundVertex), offsetof(GroundVertex, position));
    layout.attribute(1, 3, vertices, sizeof(GroundVertex), offsetof(GroundVertex, normal));
    return layout;
}

/// Replaces a buffer's contents without waiting for draws that still read the old ones.
template <typename T>
void refill(gpu::Buffer& buffer, const std::vector<T>& values) {
    if (values.empty()) return;
    const std::size_t bytes = values.size() * sizeof(T);
    std::memcpy(buffer.mapForWriting(bytes), values.data(), bytes);
    buffer.unmap();
}

void appendRectangle(std::vector<GroundVertex>& corners, const glm::vec2& minimum, const glm::vec2& maximum) {
    const glm::vec3 up(0, 1, 0);
    const GroundVertex a{{minimum.x, 0, minimum.y}, up}, b{{maximum.x, 0, minimum.y}, up};
    const GroundVertex c{{minimum.x, 0, maximum.y}, up}, d{{maximum.x, 0, maximum.y}, up};
    corners.insert(corners.end(), {a, c, d, a, d, b});
}

constexpr std::uint64_t seed = 0x6475737462656e63;  // arbitrary constant: all runs show the same ground

constexpr std::size_t rowsPerBlock = 32;

/// Random streams of the fields.
enum Stream : std::uint32_t { reliefNoise = 0, toneNoise = 100, hueNoise = 200, patchNoise = 300, stones = 400 };

/// A periodic square field of numbers.
class Field {
 public:
    explicit Field(int size) : size_(size), values_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

    float& at(int x, int y) { return values_[indexOf(x, y)]; }
    [[nodiscard]] float at(int x, int y) const { return values_[indexOf(x, y)]; }
    [[nodiscard]] int size() const { return size_; }

 private:
    [[nodiscard]] std::size_t indexOf(int x, int y) const {
        const int mask = size_ - 1;  // sizes are powers of two
        return static_cast<std::size_t>(y & mask) * static_cast<std::size_t>(size_) +
               static_cast<std::size_t>(x & mask);
    }

    int size_;
    std::vector<float> values_;
};

float fade(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

float mix(float a, float b, float share) {
    return a + share * (b - a);
}

template <typename Work>
void forEachRow(int rows, const Work& work) {
    parallel::forEachBlock(static_cast<std::size_t>(rows), rowsPerBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t row = first; row < first + count; ++row) work(static_cast<int>(row));
    });
}

/// Adds gradient noise with a periodic lattice of `periods` random slopes along each side. Source: Perlin2002.
void addNoise(Field& field, int periods, float amplitude, std::uint32_t stream) {
    std::vector<glm::vec2> slopes(static_cast<std::size_t>(periods) * static_cast<std::size_t>(periods));
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const auto random = maths::uniform4(seed, stream, i);
        slopes[i] = {maths::centred(random[0]), maths::centred(random[1])};
    }
    // Position of a texel's centre along one axis: two lattice points, the fraction between them, and the faded
    // fraction.
    struct Place {
        std::size_t before, after;
        float share, faded;
    };
    std::vector<Place> places;
    for (int n = 0; n < field.size(); ++n) {
        const float along =
            (static_cast<float>(n) + 0.5f) * static_cast<float>(periods) / static_cast<float>(field.size());
        const int before = static_cast<int>(along);
        const float share = along - static_cast<float>(before);
        places.push_back(
            {static_cast<std::size_t>(before), static_cast<std::size_t>((before + 1) % periods), share, fade(share)});
    }
    forEachRow(field.size(), [&](int y) {
        const Place& v = places[static_cast<std::size_t>(y)];
        const glm::vec2* upperRow = &slopes[v.before * static_cast<std::size_t>(periods)];
        const glm::vec2* lowerRow = &slopes[v.after * static_cast<std::size_t>(periods)];
        for (int x = 0; x < field.size(); ++x) {
            const Place& u = places[static_cast<std::size_t>(x)];
            const float s = u.share, t = v.share;
            const float upper =
                mix(glm::dot(upperRow[u.before], {s, t}), glm::dot(upperRow[u.after], {s - 1, t}), u.faded);
            const float lower =
                mix(glm::dot(lowerRow[u.before], {s, t - 1}), glm::dot(lowerRow[u.after], {s - 1, t - 1}), u.faded);
            field.at(x, y) += amplitude * mix(upper, lower, v.faded);
        }
    });
}

/// Octaves of noise from `firstPeriods` on; each has twice the frequency and `persistence` times the amplitude of the
/// last.
Field makeNoise(int size, int firstPeriods, int octaves, float amplitude, float persistence, std::uint32_t stream) {
    Field field(size);
    for (int octave = 0; octave < octaves; ++octave, amplitude *= persistence)
        addNoise(field, firstPeriods << octave, amplitude, stream + static_cast<std::uint32_t>(octave));
    return field;
}

/// Adds half-buried stones: each a dome on the relief with its own tone.
void addStones(Field& relief, Field& tone, int count) {
    const auto size = static_cast<float>(relief.size());
    for (int n = 0; n < count; ++n) {
        const auto random = maths::uniform4(seed, stones, static_cast<std::uint64_t>(n));
        const auto more = maths::uniform4(seed, stones, static_cast<std::uint64_t>(n), 1);
        const float u2 = random[2] * random[2];
        const float radius = 0.8f + 3.2f * u2 * u2;  // texels: many small, few large
        const float stretch = 0.75f + 0.5f * more[0];
        const float centreX = random[0] * size, centreY = random[1] * size;
        const int reach = static_cast<int>(std::ceil(radius * 1.35f));
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const float x = (static_cast<float>(dx) - (centreX - std::floor(centreX))) * stretch;
                const float y = (static_cast<float>(dy) - (centreY - std::floor(centreY))) / stretch;
                const float dome = 1 - (x * x + y * y) / (radius * radius);
                if (dome <= 0) continue;
                const int i = static_cast<int>(centreX) + dx, j = static_cast<int>(centreY) + dy;
                relief.at(i, j) += 0.55f * radius * std::sqrt(dome);
                tone.at(i, j) += (0.9f * random[3] - 0.4f) * std::min(1.0f, 2 * dome);
            }
    }
}

/// Dirt before it is coloured and lit: the same in all scenes, so it is made once.
struct Dirt {
    // Heights are in texels, so that slopes are plain differences.
    Field relief = makeNoise(detailTexels, 16, 5, 3.6f, 0.56f, reliefNoise);
    Field tone = makeNoise(detailTexels, 16, 5, 0.26f, 0.8f, toneNoise);
    Field hue = makeNoise(detailTexels, 16, 4, 0.07f, 0.8f, hueNoise);

    Dirt() { addStones(relief, tone, 5200); }
};

const Dirt& dirt() {
    static const Dirt made;
    return made;
}

std::uint8_t toByte(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

}  // namespace

glm::vec3 GroundPass::albedo(const scene::Scene& scene) {
    return packedShare * scene.dustAlbedo;
}

GroundPass::Programs::Programs(gpu::Device& device, const scene::Scene& scene, bool lamps)
    : plain(groundProgram(device, "ground", scene, lamps, false, false)),
      shaded(groundProgram(device, "ground in shadow", scene, lamps, hasTrack(scene), true)) {
    if (hasTrack(scene)) track = groundProgram(device, "ground track", scene, lamps, true, false);
}

GroundPass::GroundPass(gpu::Device& device, const scene::Scene& scene)
    : device_(device),
      scene_(scene),
      hasTrack_(hasTrack(scene)),
      lattice_(scene.terrain),
      detail_(gpu::Texture::make2D(device, "ground detail", gpu::Format::srgba8, detailTexels, detailTexels,
                                   gpu::Filter::mipmapped, gpu::Wrap::repeat)),
      patches_(gpu::Texture::make2D(device, "ground patches", gpu::Format::rgba8, patchTexels, patchTexels,
                                    gpu::Filter::mipmapped, gpu::Wrap::repeat)),
      programs_(device, scene, false) {
    detail_.write(std::span<const std::uint8_t>(makeGroundDetail(albedo(scene), scene.lights.toSun)));
    patches_.write(std::span<const std::uint8_t>(groundPatches()));

    lattice_.moveTo(glm::dvec3(0));
    vertices_ = gpu::Buffer(device, "ground vertices", lattice_.vertices());
    visible_ = gpu::Buffer(device, "ground indices", lattice_.maximumIndices() * sizeof(std::uint32_t));
    latticeLayout_ = layoutOf(device, vertices_);
    latticeLayout_.indices(visible_);
    if (!scene.terrain.isFlat()) {
        shadedIndices_ = gpu::Buffer(device, "ground in shadow", lattice_.maximumIndices() * sizeof(std::uint32_t));
        shadedLayout_ = layoutOf(device, vertices_);
        shadedLayout_.indices(shadedIndices_);
    }
    if (hasTrack_) {
        trackVertices_ = gpu::Buffer(device, "ground track", (trackCutsMetres.size() - 1) * 6 * sizeof(GroundVertex));
        trackLayout_ = layoutOf(device, trackVertices_);
    }
}

void GroundPass::place(gpu::Program& program, const glm::dvec3& eye, bool withTrack) {
    const glm::dvec3& anchor = lattice_.anchor();
    const glm::dvec2 tiles = glm::dvec2(anchor.x, anchor.z) / patchTileMetres;
    program.set("anchorFromEye", glm::vec3(anchor - eye));
    program.set("anchorPhase", glm::vec2(tiles - glm::floor(tiles)));
    if (withTrack) program.set("anchorAcross", static_cast<float>(anchor.z));
}

void GroundPass::draw(const glm::dvec3& eye, const glm::mat4& eyeToClip, std::span<const GroundRectangle> shaded,
                      bool lamps) {
    if (lamps && !withLamps_) withLamps_.emplace(device_, scene_, true);
    Programs& programs = lamps ? *withLamps_ : programs_;
    if (lattice_.moveTo(eye)) {
        const auto vertices = lattice_.vertices();
        std::memcpy(vertices_.mapForWriting(vertices.size_bytes()), vertices.data(), vertices.size_bytes());
        vertices_.unmap();
    }
    glm::mat4 anchorToEye(1);
    anchorToEye[3] = glm::vec4(glm::vec3(lattice_.anchor() - eye), 1);
    indices_.clear();
    lattice_.appendVisible(eyeToClip * anchorToEye, indices_);
    refill(visible_, indices_);

    detail_.bind(0);
    patches_.bind(1);
    place(programs.plain, eye, false);
    gpu::drawIndexed(programs.plain, latticeLayout_, {.depthTest = true, .depthWrite = true},
                     gpu::Primitives::triangles, static_cast<int>(indices_.size()));
    if (hasTrack_) {
        place(programs.track, eye, true);
        drawTrack(programs.track);
    }
    if (shaded.empty()) return;
    place(programs.shaded, eye, hasTrack_);
    if (scene_.terrain.isFlat())
        drawShadedRectangles(programs.shaded, shaded);
    else
        drawShadedTriangles(programs.shaded, shaded);
}

void GroundPass::drawTrack(gpu::Program& program) {
    // The track needs no depth test: level ground does not occlude itself and is drawn first.
    const auto across = static_cast<float>(-lattice_.anchor().z);
    corners_.clear();
    for (std::size_t i = 0; i + 1 < trackCutsMetres.size(); ++i)
        appendRectangle(corners_, {trackCutsMetres[i], across - trackHalfWidthMetres},
                        {trackCutsMetres[i + 1], across + trackHalfWidthMetres});
    refill(trackVertices_, corners_);
    gpu::draw(program, trackLayout_, {}, gpu::Primitives::triangles, static_cast<int>(corners_.size()));
}

void GroundPass::drawShadedRectangles(gpu::Program& program, std::span<const GroundRectangle> shaded) {
    const glm::dvec2 anchor(lattice_.anchor().x, lattice_.anchor().z);
    corners_.clear();
    for (const GroundRectangle& rectangle : shaded)
        appendRectangle(corners_, glm::vec2(rectangle.minimum - anchor), glm::vec2(rectangle.maximum - anchor));
    if (const std::size_t bytes = corners_.size() * sizeof(GroundVertex); bytes > rectangles_.bytes()) {
        rectangles_ = gpu::Buffer(device_, "ground in shadow", 2 * bytes);
        rectangleLayout_ = layoutOf(device_, rectangles_);
    }
    refill(rectangles_, corners_);
    gpu::draw(program, rectangleLayout_, {}, gpu::Primitives::triangles, static_cast<int>(corners_.size()));
}

void GroundPass::drawShadedTriangles(gpu::Program& program, std::span<const GroundRectangle> shaded) {
    // The same triangles as in the first pass, so that their depths are bit-identical.
    indices_.clear();
    lattice_.appendWithin(shaded, indices_);
    refill(shadedIndices_, indices_);
    gpu::drawIndexed(program, shadedLayout_, {.depthTest = true}, gpu::Primitives::triangles,
                     static_cast<int>(indices_.size()));
}

std::vector<std::uint8_t> makeGroundDetail(glm::vec3 albedo, glm::vec3 toSun) {
    const auto& [relief, tone, hue] = dirt();

    // Raises a low sun, which would put everything in shade: the relief must be visible, not physically correct.
    const glm::vec3 light = glm::normalize(glm::vec3(toSun.x, std::max(toSun.y, 0.5f), toSun.z));
    std::vector<glm::vec3> colours;
    glm::dvec3 sum(0);
    for (int y = 0; y < detailTexels; ++y)
        for (int x = 0; x < detailTexels; ++x) {
            const float slopeX = (relief.at(x + 1, y) - relief.at(x - 1, y)) / 2;
            const float slopeZ = (relief.at(x, y + 1) - relief.at(x, y - 1)) / 2;
            const glm::vec3 normal = glm::normalize(glm::vec3(-slopeX, 1, -slopeZ));
            const float shade = std::clamp(0.35f + 0.65f * glm::dot(normal, light) / light.y, 0.25f, 1.5f);
            const float warmth = hue.at(x, y);
            const glm::vec3 tint(1 + warmth, 1, 1 - warmth);
            colours.push_back(albedo * tint * shade * std::clamp(1 + tone.at(x, y), 0.35f, 1.8f));
            sum += colours.back();
        }
    const glm::vec3 toMean = albedo / glm::vec3(sum / static_cast<double>(colours.size()));
    std::vector<std::uint8_t> bytes(4 * colours.size(), 255);
    forEachRow(detailTexels, [&](int y) {
        const std::size_t first = static_cast<std::size_t>(y) * detailTexels;
        for (std::size_t i = first; i < first + detailTexels; ++i)
            for (int channel = 0; channel < 3; ++channel)
                bytes[4 * i + static_cast<std::size_t>(channel)] =
                    toByte(maths::encodeSrgb(colours[i][channel] * toMean[channel]));
    });
    return bytes;
}

const std::vector<std::uint8_t>& groundPatches() {
    static const std::vector<std::uint8_t> made = [] {
        const Field tone = makeNoise(patchTexels, 4, 7, 0.26f, 0.93f, patchNoise);
        const Field warmth = makeNoise(patchTexels, 6, 5, 0.06f, 0.8f, patchNoise + 50);
        std::vector<std::uint8_t> bytes;
        for (int y = 0; y < patchTexels; ++y)
            for (int x = 0; x < patchTexels; ++x) {
                const float brightness = std::clamp(1 + tone.at(x, y), 0.5f, 1.6f);
                const float warm = warmth.at(x, y);
                for (const float factor : {1 + warm, 1.0f, 1 - warm})
                    bytes.push_back(toByte(brightness * factor * 128 / 255));
                bytes.push_back(255);
            }
        return bytes;
    }();
    return made;
}

}  // namespace dustbench::draw
