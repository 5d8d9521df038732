// The stages of a frame, and the clock that times them. Costs one branch without a listener.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace dustbench {

/// The fixed stages of a frame, in order. Together they make up the frame.
enum class Stage { input, simulate, build, sort, upload, scene, draw, wait };

inline constexpr std::array<std::string_view, 8> stageNames{"input",  "simulate", "build", "sort",
                                                            "upload", "scene",    "draw",  "wait"};

/// Receives the start and end of stages. Scopes nest: an inner stage's time is not part of the outer stage's.
class DUSTBENCH_API StageListener {
 public:
    virtual ~StageListener();
    virtual void begin(Stage stage) = 0;
    virtual void end(Stage stage) = 0;
    /// A finer stage that the method names itself (`advect`, `project`); `name` must outlive the run.
    virtual void beginDetail(std::string_view name) = 0;
    virtual void endDetail(std::string_view name) = 0;
};

/// Passed to a method with each frame: `const auto timing = frame.clock.measure(Stage::sort);` times the rest of the
/// block.
class StageClock {
 public:
    explicit StageClock(StageListener* listener = nullptr) : listener_(listener) {}

    class [[nodiscard]] Scope {
     public:
        Scope(StageListener* listener, Stage stage) : listener_(listener), stage_(stage) {
            if (listener_) listener_->begin(stage_);
        }
        ~Scope() {
            if (listener_) listener_->end(stage_);
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

     private:
        StageListener* listener_;
        Stage stage_;
    };

    class [[nodiscard]] DetailScope {
     public:
        DetailScope(StageListener* listener, std::string_view name) : listener_(listener), name_(name) {
            if (listener_) listener_->beginDetail(name_);
        }
        ~DetailScope() {
            if (listener_) listener_->endDetail(name_);
        }
        DetailScope(const DetailScope&) = delete;
        DetailScope& operator=(const DetailScope&) = delete;

     private:
        StageListener* listener_;
        std::string_view name_;
    };

    Scope measure(Stage stage) const { return {listener_, stage}; }
    DetailScope measureDetail(std::string_view name) const { return {listener_, name}; }

 private:
    StageListener* listener_;
};

}  // namespace dustbench
