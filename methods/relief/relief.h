// Reliefs that dust wears away: particles enter a panel through its face, move within it, hit its surface and age it.
//
// Source: Bergeron. Departs: particles come from the shared dust and are drawn within the relief, both of which the
// source names as future work.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/draw/billboards.h"
#include "methods/kit/draw/depth_sort.h"
#include "methods/kit/draw/shadow_map.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/relief/drawing/relief_pass.h"
#include "methods/relief/living_relief.h"

namespace dustbench::relief {

struct Settings {
    ReliefSettings relief;
    float grainMetres = 0.006f;  ///< radius at which a particle is drawn within a relief
};

class Relief final : public Method {
 public:
    explicit Relief(const Settings& settings);

    void prepare(const scene::Scene& scene, const RunSetup& setup, gpu::Device& device) override;
    void update(const Frame& frame) override;
    void draw(const Frame& frame, gpu::Layer& layer) override;

    void volume(const Frame& frame, VolumeVisitor& visitor) const override;
    void report(const Frame& frame, Facts& facts) const override;
    [[nodiscard]] MemoryReport memory() const override;
    [[nodiscard]] std::int64_t primitives() const override;
    [[nodiscard]] std::optional<std::uint64_t> stateHash() const override;
    [[nodiscard]] bool wantsPreroll() const override { return true; }

 private:
    void simulate(const Frame& frame);
    void uploadDust(const Puffs& dust, const glm::vec3& eye);
    void uploadGrains(const Frame& frame);
    [[nodiscard]] std::vector<glm::vec3> litGrains(const Frame& frame) const;
    void copyDust(const Puffs& dust) const;
    void copyGrains(double stepSeconds) const;

    Settings settings_;
    MemoryLedger ledger_;
    SerialSet taken_{ledger_};
    draw::DepthSort sort_{ledger_};
    LedgerVector<std::uint32_t> visible_{
        ledger_.account("visible dust")};                   ///< dust outside the reliefs, from far to near
    mutable particles::ParticleStore handedOver_{ledger_};  ///< particles last passed on by `volume`
    std::deque<LivingRelief> reliefs_;
    std::optional<CarShadow> carShadow_;
    std::optional<draw::DustShadow> dustShadow_;  ///< if the scene's lights are on the dust
    const scene::Scene* scene_ = nullptr;
    std::optional<SceneWithReliefs> target_;
    std::optional<draw::Billboards> dust_, grains_;
    gpu::Device* device_ = nullptr;
};

[[nodiscard]] MethodInfo describe();

}  // namespace dustbench::relief
