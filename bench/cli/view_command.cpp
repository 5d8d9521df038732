// `dustbench view`: opens the interactive window, or draws one frame of it to a picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/run/measured_run.h"
#include "bench/view/keys.h"
#include "bench/view/split_view.h"
#include "bench/view/view_state.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/whole_text.h"
#ifdef DUSTBENCH_PANELS
#include "bench/view/panels/viewer_panels.h"
#endif
#ifdef DUSTBENCH_WINDOW
#include "bench/view/window/view_window.h"
#endif

namespace dustbench::cli {
namespace {

struct ViewOptions {
    WorldOptions world;
    std::string with, state, picture, windowSize = "1280x720", out = "view";
    std::string show = "wipe", channel = "picture";
    std::int64_t frame = 0;
};

[[maybe_unused]] InputError missing(const char* what) {
    return InputError(
        fmt::format("view: this program was built without {}; install the packages libglfw3-dev, "
                    "libimgui-dev and libgl1 (.ci/install view), then `make build`",
                    what));
}

view::HalfState halfOf(const std::string& method, const suite::ParameterLists& given) {
    if (method == view::exactPicture) return {method, {}};
    view::HalfState half{findMethod(method).id, {}};
    for (const auto& [name, values] : given)
        if (findMethod(method).parameters.find(name)) half.parameters[name] = values.front();
    return half;
}

view::ViewState ofOptions(const ViewOptions& options) {
    WorldOptions world = options.world;
    const bool byKeyboard = world.drive == view::keyboardDrive;
    if (byKeyboard) world.drive.clear();
    const results::RunSpec spec = world.toWorldSpec();
    if (spec.dustOn == results::DustOn::gpu)
        throw InputError("--dust-on: got gpu, allowed in the window: cpu|auto (its dust is always on the CPU)");
    view::ViewState state;
    state.scene = spec.scene;
    state.drive = byKeyboard ? view::keyboardDrive : spec.drive;
    state.cameraPath = spec.cameraPath;
    state.dust = spec.dust;
    state.dustColumns = spec.dustColumns;
    state.seed = spec.seed;
    state.size = spec.size;
    state.threads = spec.threads;
    state.warmup = spec.warmup;
    state.frame = options.frame;
    const suite::ParameterLists given = parseParameters(world.parameters);
    state.a = halfOf(world.method, given);
    if (!options.with.empty()) state.b = halfOf(options.with, given);
    for (const auto& [name, values] : given) {
        if (values.size() != 1)
            throw InputError(fmt::format("-P: parameter {}: got {} values, expected one", name, values.size()));
        const bool isOfHalf = state.a.parameters.contains(name) || (state.b && state.b->parameters.contains(name));
        if (!isOfHalf) (void)results::resolveParameters(findMethod(state.a.method), {{name, values.front()}});
        if (!isOfHalf) state.world[name] = values.front();
    }
    return view::normalised(state);
}

view::ViewState ofFile(const std::string& file) {
    return view::stateOfToml(files::wholeText(file, "a TOML file"), file);
}

[[maybe_unused]] view::SplitSettings splitOf(const ViewOptions& options) {
    view::SplitSettings split;
    split.shown = view::shownChoices.parse("--show", options.show);
    split.channel = view::channelChoices.parse("--channel", options.channel);
    return split;
}

int view(const ViewOptions& options) {
    const view::ViewState state = options.state.empty() ? ofOptions(options) : ofFile(options.state);
    if (!options.picture.empty()) {
#ifdef DUSTBENCH_PANELS
        const results::ImageSize size = results::parseSize(options.windowSize);
        const view::SplitSettings split = splitOf(options);
        run::withThreads(state.threads, [&] {
            const pictures::Image picture = view::panelPicture(state, split, size.width, size.height);
            const std::filesystem::path file(options.picture);
            if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
            pictures::writeImage(picture, file);
        });
        return exitOk;
#else
        throw missing("Dear ImGui");
#endif
    }
#ifdef DUSTBENCH_WINDOW
    run::withThreads(state.threads, [&] { view::showWindow(state, options.out, childExecution()); });
    return exitOk;
#else
    throw missing("a window");
#endif
}

std::string keysText() {
    std::string text = "Keys:";
    for (const view::KeyBinding& binding : view::keyBindings())
        if (!binding.name.empty()) text += fmt::format("\n  {:<10} {}", binding.name, binding.help);
    return text;
}

}  // namespace

Command viewCommand() {
    auto options = std::make_shared<ViewOptions>();
    options->world.method = "billboard";
    options->world.warmup = 0;
    return {"view", "Show one method, or two at once, in a window",
            "To drive the vehicle yourself, use `--drive keyboard`. Nothing shown in the window is a measurement.\n" +
                keysText(),
            [options](Arguments& arguments) {
                arguments.text("--method", "ID", "picture A: one of `dustbench list methods`", options->world.method);
                arguments.text("--with", "ID", "picture B, next to A: a method, or 'exact' for the ground truth",
                               options->with);
                options->world.declareWorld(arguments);
                arguments.integer("--frame", "go to this frame first", options->frame, 0, 10'000'000);
                arguments.text("--state", "FILE", "saved settings, instead of the options above", options->state);
                arguments.text("--picture", "FILE", "draw the window to a picture (.png, .exr) instead of opening it",
                               options->picture);
                arguments.text("--show", "A|B|wipe|beside|difference|flip", "for --picture: how A and B are combined",
                               options->show);
                arguments.text("--channel", "picture|alpha|depth|overdraw|outlines|faults",
                               "for --picture: what it shows of A and B", options->channel);
                arguments.text("--window", "WxH", "for --picture: size in pixels", options->windowSize);
                arguments.text("--out", "DIR", "folder for saved files; created when needed", options->out);
            },
            [options] { return view(*options); }};
}

}  // namespace dustbench::cli
