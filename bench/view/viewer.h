// The logic of the window without a window: a session, the composition of its two pictures, and the actions of keys and
// panels.
//
// An error in the user's input becomes a message and the last state stays. A failed simulation is paused. Owns: session
// and composed picture. Threads: the device's.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/view/draw_pace.h"
#include "bench/view/keys.h"
#include "bench/view/moment_maps.h"
#include "bench/view/shown_measurement.h"
#include "bench/view/split_view.h"
#include "bench/view/view_session.h"

namespace dustbench::view {

/// Slow motion: full speed, half, a quarter, an eighth.
inline constexpr std::array<int, 4> slownesses{1, 2, 4, 8};

/// Milliseconds of a frame of the window: from one advance() to the next.
struct FrameCost {
    double world = 0;                  ///< the step that both halves share
    std::array<HalfCost, 2> halves{};  ///< of A and B: only work of this frame, without the ground truth
    double window = 0;                 ///< the rest: composing, maps, the ground truth, panels, the display
    [[nodiscard]] double methodsMs() const { return world + halves[0].totalMs() + halves[1].totalMs(); }
};

/// One pixel of a half. x and y count from the upper left corner.
struct PixelValue {
    Half half;
    int x, y;
    glm::vec3 light;    ///< linear
    glm::vec3 display;  ///< encoded, 0..1
    float alpha;        ///< of the layer
};

class Viewer {
 public:
    /// Files are saved in `folder`, which is created for the first one.
    Viewer(const ViewState& state, gpu::Device& device, std::filesystem::path folder);

    void press(Key key, bool control);
    void release(Key key);
    /// Takes the current state of a gamepad. Buttons act when they are pressed down.
    void usePad(const PadState& pad);
    void act(Action action);

    /// Sets the state, or a message if it cannot be shown.
    void apply(const ViewState& state);
    /// Applies a `run` line or TOML, such as pasted text.
    void applyText(const std::string& text);
    /// The same for the text of a file that was dropped on the window.
    void applyFile(const std::filesystem::path& file);
    /// Shows a message of the calling program.
    void say(std::string message) { message_ = std::move(message); }

    /// Makes a frame of the window: steps unless paused (the preroll for at most `secondsForPreroll`), draws and
    /// composes unless drawing is paused. Throws InputError if the OpenGL context is lost.
    void advance(double secondsForPreroll = 0.05);
    /// The composed picture of the last advance(), without panels, display-encoded.
    [[nodiscard]] const gpu::Texture& image() const { return image_; }
    /// Describes the picture: its frame, the halves and the channel.
    [[nodiscard]] const std::string& stamp() const { return stamp_; }
    /// `split`, but A alone as long as half B does not show this moment, and flipped while the key is held.
    [[nodiscard]] SplitSettings settingsNow() const;
    [[nodiscard]] const MomentMaps& maps() const { return maps_; }
    [[nodiscard]] const LayerFaults& faults(Half half) { return maps_.faults(session_, half); }
    /// Pixel at a position in image(), in shares from its upper left corner.
    [[nodiscard]] PixelValue valueAt(glm::vec2 place);

    /// Enlarges by a factor above 0, with `place` fixed. Shows at most the whole picture and at least 8 pixels.
    void zoom(glm::vec2 place, double factor);
    /// Moves the enlarged picture by shares of image() to the right and down.
    void pan(glm::vec2 shares);

    /// Moves the camera by hand (free_camera.h), which then stays fixed in the world. Shares of the picture's height.
    void turnCamera(double right, double up);
    void shiftCamera(double right, double up);
    void dollyCamera(double factor);

    /// Costs of the last frames after the preroll, oldest first. The window's share is known when a frame has ended.
    [[nodiscard]] std::span<const FrameCost> costs() const { return costs_; }
    static constexpr std::size_t keptFrames = 120;

    /// The last complete frame for DrawPace, once, if it was drawn as drawShare and drawsOnlyShown ask for.
    [[nodiscard]] std::optional<PacedFrame> takePaced() { return std::exchange(paced_, {}); }
    /// `drawn at 480x360 of 800x600, where it is shown, to keep 15 frames per second`; empty for whole pictures at full
    /// size.
    [[nodiscard]] std::string drawnRemark() const;

    /// Sets the function that is called after every frame, and when one fails. By default it asks the driver.
    void watchContext(std::function<bool()> isLost) { isLost_ = std::move(isLost); }

    /// Enables Action::measure, which otherwise is an error. A measurement runs in the next advance(), which then takes
    /// minutes; message() reports its progress.
    void setMeasurement(MeasurementHooks hooks) { measurement_ = std::move(hooks); }
    /// Times and verdicts of the last measurement, as sentences.
    [[nodiscard]] const std::vector<std::string>& measured() const { return measured_; }

    [[nodiscard]] const ViewSession& session() const { return session_; }
    [[nodiscard]] ViewState state() const { return session_.state(); }
    /// The command that draws a half's picture, or the error if there is none.
    [[nodiscard]] std::string line(Half half) const;
    /// Text for the clipboard, once.
    [[nodiscard]] std::string takeCopied() { return std::exchange(copied_, {}); }
    [[nodiscard]] const std::string& message() const { return message_; }
    [[nodiscard]] bool wantsToQuit() const { return quit_; }

    SplitSettings split;
    bool exactEveryFrame = false;  ///< otherwise the ground truth with metrics is drawn only when nothing moves
    int slowness = 1;              ///< frames of the window per step of the world: one of `slownesses`
    bool drawingPaused = false;    ///< the world continues; a frame is drawn only when state or view changes
    /// While something moves, the halves are drawn at `drawShare` of width and height (draw_pace.h) and scaled up, or
    /// only where they are shown. When nothing moves, and for metrics, maps and saved pictures, they are drawn whole
    /// and at full size.
    bool keepsPace = false;
    double drawShare = 1;
    bool drawsOnlyShown = false;
    bool paused = false, showsPanels = true, showsHelp = false;
    bool walksPanel = false;  ///< the arrow keys control the panel

 private:
    /// Turns errors into the message; pauses a failed simulation.
    void attempt(const std::function<void()>& work);
    void perform(Action action);
    [[nodiscard]] bool holds(Action action) const;
    void drive();
    void goOn(double secondsForPreroll);
    void makeFrame(double secondsForPreroll);
    void requireContext() const;
    void measureShown();
    /// False if drawing is paused or everything is drawn.
    bool draw();
    void drawAtFullSize();
    [[nodiscard]] bool isPaced() const;
    [[nodiscard]] bool nothingMoves() const { return paused && !session_.isBehind(); }
    [[nodiscard]] results::ImageSize sizeNow() const;
    [[nodiscard]] PictureParts partsNow() const;
    void noteCost(bool wasStepped, bool wasDrawn);
    void drawExact();
    void compose(const SplitSettings& settings);
    [[nodiscard]] HalfTextures texturesOf(Half half, const SplitSettings& settings);
    [[nodiscard]] std::string stampOf(const SplitSettings& settings) const;
    [[nodiscard]] glm::vec3 onePixel(Half half, glm::ivec2 pixel, const SplitSettings& settings);
    void makeImage(Shown shown);
    void save(const std::string& name, const std::string& text);
    void savePicture();
    void saveVolume();
    [[nodiscard]] std::string frameName() const;
    /// The light of image(), before it is encoded for display.
    [[nodiscard]] pictures::Image lightOfImage();
    /// Half B if it can be shown, otherwise A.
    [[nodiscard]] Half secondHalf() const;
    template <typename Move>
    void moveCamera(const Move& move);

    gpu::Device& device_;
    std::filesystem::path folder_;
    ViewSession session_;
    SplitView splitView_;
    MomentMaps maps_;
    gpu::Texture image_, pixel_;
    gpu::Framebuffer target_, pixelTarget_;
    std::int64_t momentBefore_ = -1;  ///< of the previous frame
    bool exactAsked_ = false, measureAsked_ = false, mustDraw_ = true;
    std::optional<MeasurementHooks> measurement_;
    std::vector<std::string> measured_;
    SplitSettings composed_;  ///< settings of image()
    std::int64_t framesSinceStep_ = 0;
    std::vector<FrameCost> costs_;
    std::int64_t frameStart_ = 0;  ///< of the last advance(), ns
    bool isCosted_ = false;        ///< the last advance() has an entry in costs_
    bool wasPaced_ = false;        ///< and was drawn at drawShare
    std::optional<PacedFrame> paced_;
    std::string stamp_;
    std::array<bool, keyCount> held_{};
    PadState pad_;
    std::vector<world::CameraKey> cameraKeys_;
    std::string message_, copied_;
    std::function<bool()> isLost_;
    bool quit_ = false;
};

}  // namespace dustbench::view
