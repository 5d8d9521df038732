#include "methods/linked_list/linked_list.h"

#include <algorithm>
#include <array>
#include <string>

#include "draw_shaders.h"
#include "linked_list_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/draw/cost_facts.h"
#include "methods/kit/gpu/layer.h"

namespace dustbench::linked_list {
namespace {

constexpr std::size_t linkBytes = 8, valueBytes = 8;  ///< of a fragment, in each of the pool's two buffers
constexpr std::size_t headBytes = 4;                  ///< of a pixel
constexpr int groupPixels = 8;                        ///< edge of a work group of sort_fragments.comp

}  // namespace

void LinkedList::prepare(const scene::Scene&, const RunSetup&, gpu::Device& device) {
    device_ = &device;
    quads_.emplace(device, reach_);
    loops_.emplace(device);
    counter_ = gpu::Buffer(device, "fragment counter", 2 * sizeof(std::uint32_t));
    std::map<std::string, std::string> definitions;
    if (puff_ == Puff::surface) definitions["SURFACE"] = "";
    append_ = draw::puffPass("linked lists: append", {linked_list_shaders::append_fragment_frag}, definitions);
}

void LinkedList::update(const Frame& frame) {
    const auto timing = frame.clock.measure(Stage::upload);
    frame.gpuDust ? quads_->gather(*frame.gpuDust) : quads_->upload(frame.dust);
}

void LinkedList::draw(const Frame& frame, gpu::Layer& layer) {
    found_ = 0;
    if (quads_->count() == 0) return;
    fitLists(layer.width(), layer.height());
    append(frame, layer);
    requireRoom();
    sortAndBlend(frame, layer);
}

void LinkedList::fitLists(int width, int height) {
    if (width == width_ && height == height_) return;
    heads_ = {}, links_ = {}, fragments_ = {};  // frees memory before more is taken
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    const std::uint64_t most = device_->maximumStorageBytes() / std::max(linkBytes, valueBytes) - 1;
    capacity_ = std::min(pixels * static_cast<std::uint64_t>(fragmentsPerPixel_), most);
    heads_ = gpu::Buffer(*device_, "lists of fragments", pixels * headBytes);
    links_ = gpu::Buffer(*device_, "links of fragments", (capacity_ + 1) * linkBytes);  // number 0 ends a list
    fragments_ = gpu::Buffer(*device_, "fragments", (capacity_ + 1) * valueBytes);
    width_ = width, height_ = height;
}

void LinkedList::append(const Frame& frame, gpu::Layer& layer) {
    gpu::Program& program = quads_->begin(*append_, frame.view);
    program.set("pictureWidth", width_);
    heads_.clear();
    counter_.clear();
    heads_.bindStorage(1);
    links_.bindStorage(2);
    fragments_.bindStorage(3);
    counter_.bindStorage(4);
    layer.bindColourOnly();
    quads_->store(program, layer.sceneDepth());
    std::array<std::uint32_t, 2> count{};
    counter_.read(std::span<std::uint32_t>(count));
    found_ = count[0] + (std::uint64_t{count[1]} << 32);
}

void LinkedList::requireRoom() const {
    if (found_ <= capacity_) return;
    const auto pixels = static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
    const bool asAsked = capacity_ == pixels * static_cast<std::uint64_t>(fragmentsPerPixel_);
    throw InputError("linked_list: got " + std::to_string(found_) + " fragments at " + std::to_string(width_) + "x" +
                     std::to_string(height_) + " pixels, expected at most " + std::to_string(capacity_) +
                     (asAsked ? " (fragments_per_pixel=" + std::to_string(fragmentsPerPixel_) + "; " +
                                    std::to_string((found_ + pixels - 1) / pixels) + " is sufficient)"
                              : " (a buffer of this device holds no more)"));
}

void LinkedList::sortAndBlend(const Frame& frame, gpu::Layer& layer) {
    const bool coloured = quads_->isColoured();
    std::optional<gpu::Program>& made = coloured ? blendColours_ : blendOneColour_;
    if (!made) {
        std::map<std::string, std::string> definitions{{"FLOATS", std::to_string(quads_->floats())}};
        if (coloured) definitions["COLOURED"] = "";
        made.emplace(*device_, "linked lists: sort",
                     std::initializer_list<gpu::ShaderFile>{draw_shaders::loop_limit_glsl,
                                                            linked_list_shaders::sort_fragments_comp},
                     definitions);
    }
    if (coloured)
        quads_->bindValues(0);
    else
        made->set("colourOfAll", frame.dust.colourOfAll);
    heads_.bindStorage(1);
    links_.bindStorage(2);
    fragments_.bindStorage(3);
    loops_->bind(*made);
    layer.colour().bindImage(0, false, true);
    const auto groups = [](int pixels) { return (pixels + groupPixels - 1) / groupPixels; };
    made->dispatch(groups(width_), groups(height_), 1);
}

void LinkedList::report(const Frame&, Facts& facts) const {
    if (loops_) loops_->requireWholeLoops("linked_list");
    if (width_ == 0) return;
    const double pixels = static_cast<double>(width_) * height_;
    const double fragmentBits = 8.0 * (linkBytes + valueBytes);
    facts.set("bits_per_pixel", 8.0 * headBytes + fragmentBits * static_cast<double>(found_) / pixels);
}

MemoryReport LinkedList::memory() const {
    MemoryReport report;
    if (quads_) report.push_back({"puffs", 0, quads_->gpuBytes()});
    report.push_back({"fragment lists", 0, heads_.bytes() + counter_.bytes()});
    report.push_back({"fragments", 0, links_.bytes() + fragments_.bytes()});
    return report;
}

std::int64_t LinkedList::primitives() const {
    return quads_ ? quads_->primitives() : 0;
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Linked lists of fragments";
    info.summary = "Collects the fragments of all puffs in a list per pixel, sorts each list by depth and blends it.";
    info.source = "YangEtAl2010";
    info.takesLights = true;
    info.parameters
        .choice("puff", Puff::surface, puffKinds,
                "a puff as a surface at its centre's depth, as published, or as a volume cut by eye and scene, at the "
                "point on the ray nearest to its centre")
        .integer("fragments_per_pixel", 32, 1, 4096, "fragments",
                 "capacity of the lists, in fragments per pixel on average; a picture that needs more is an error")
        .real("reach", 3.5, 2, 6, "deviations",
              "half-side of a puff's quad in standard deviations; exp(-reach^2/2) of its depth is cut off");
    info.facts = {draw::bitsPerPixel()};
    info.takesGpuDust = [](const ParameterValues&) { return true; };
    info.create = [](const ParameterValues& values) {
        return std::make_unique<LinkedList>(values.choice("puff", puffKinds), values.real("reach"),
                                            values.integer("fragments_per_pixel"));
    };
    return info;
}

}  // namespace dustbench::linked_list
