// Linked lists of fragments (A-buffer): a pass appends the fragments of all puffs, in any order, to a list per pixel. A
// second pass sorts each list by depth and blends it from near to far, so that every pixel has its own exact order.
//
// The lists grow by atomic operations in a pool of a fixed size. A picture with more fragments than that is an error:
// no fragment is lost without notice. Its check reads the number of fragments back, so `draw` waits for the GPU once.
// Fragments at one depth follow the order of the puffs. The picture hence does not depend on the order of appending.
//
// Source: YangEtAl2010. Departs: a fragment holds its puff's number, depth and alpha in full precision (16 bytes with
// its link), and its colour is read from the puff. Lists are sorted in place by merging, so that they may have any
// length.
#pragma once

#include <optional>

#include "methods/contract/method.h"
#include "methods/kit/draw/loop_limit.h"
#include "methods/kit/draw/puff_quads.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::linked_list {

enum class Puff {
    surface,  ///< as published: a surface at its centre's depth, with the alpha of the whole puff along the ray
    volume,   ///< cut by eye and scene, at the point on the ray nearest to its centre
};
inline constexpr Choices<Puff> puffKinds{{"surface", Puff::surface}, {"volume", Puff::volume}};

class LinkedList final : public Method {
 public:
    LinkedList(Puff puff, double reachDeviations, std::int64_t fragmentsPerPixel)
        : puff_(puff), reach_(reachDeviations), fragmentsPerPixel_(fragmentsPerPixel) {}

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    /// Throws InputError with both numbers if there are more fragments than the pool holds.
    void draw(const Frame& frame, gpu::Layer& layer) override;
    void volume(const Frame& frame, VolumeVisitor& visitor) const override { visitor.puffs(frame.dust); }
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] bool reportsAtEnd() const override { return true; }
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;

 private:
    void fitLists(int width, int height);
    void append(const Frame& frame, gpu::Layer& layer);
    void requireRoom() const;
    void sortAndBlend(const Frame& frame, gpu::Layer& layer);

    Puff puff_;
    double reach_;
    std::int64_t fragmentsPerPixel_;
    gpu::Device* device_ = nullptr;
    std::optional<draw::PuffQuads> quads_;
    std::optional<draw::FragmentPass> append_;
    std::optional<draw::LoopLimit> loops_;
    std::optional<gpu::Program> blendOneColour_, blendColours_;  ///< compiled on first use
    gpu::Buffer heads_, links_, fragments_, counter_;
    int width_ = 0, height_ = 0;
    std::uint64_t capacity_ = 0, found_ = 0;  ///< fragments that the pool holds, and those of the last picture
};

/// Called by the registry.
[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::linked_list
