#include "methods/kit/gpu/adapter.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <iterator>
#include <vector>

#include "methods/contract/errors.h"

namespace dustbench::gpu {
namespace {

using Kind = Adapter::Kind;
using Platform = Adapter::Platform;

bool isHardwareDevice(const Adapter& adapter) {
    return adapter.platform == Platform::device && adapter.kind == Kind::hardware;
}

/// Order of preference; the lowest rank is taken first.
int rank(const Adapter& adapter) {
    if (isHardwareDevice(adapter)) return 0;
    return adapter.platform == Platform::surfaceless ? 1 : 2;
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char letter) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    });
    return lower;
}

/// `0 surfaceless, 1 llvmpipe`
std::string listed(std::span<const Adapter> adapters) {
    std::string text;
    for (const Adapter& adapter : adapters)
        text += (text.empty() ? "" : ", ") + std::to_string(adapter.index) + " " + adapter.name;
    return text.empty() ? "none" : text;
}

}  // namespace

std::string_view kindName(Adapter::Kind kind) {
    return kind == Kind::hardware ? "hardware" : "software";
}

std::string_view platformName(Adapter::Platform platform) {
    return platform == Platform::device ? "device" : "surfaceless";
}

bool isSoftwareRenderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> names{"llvmpipe", "softpipe", "swrast", "SwiftShader"};
    return std::ranges::any_of(names,
                               [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

std::optional<std::size_t> preferredAdapter(std::span<const Adapter> adapters) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < adapters.size(); ++i)
        if (adapters[i].problem.empty() && (!best || rank(adapters[i]) < rank(adapters[*best]))) best = i;
    return best;
}

std::optional<std::size_t> takePreferred(std::span<Adapter> adapters, const std::function<void(Adapter&)>& open) {
    std::optional<std::size_t> opened, preferred = preferredAdapter(adapters);
    while (preferred != opened) {
        opened = preferred;
        open(adapters[*opened]);
        preferred = preferredAdapter(adapters);
    }
    return preferred;
}

std::string whyPreferred(std::span<const Adapter> adapters, std::size_t preferred) {
    std::vector<Adapter> failed;
    std::ranges::copy_if(adapters, std::back_inserter(failed),
                         [](const Adapter& each) { return isHardwareDevice(each) && !each.problem.empty(); });
    const std::string problems = failed.empty() ? "" : " that provides OpenGL 4.5 (" + problemsOf(failed) + ")";
    if (isHardwareDevice(adapters[preferred])) return "first hardware adapter" + problems;
    if (adapters[preferred].kind == Kind::hardware) return "EGL lists no hardware device" + problems + ": surfaceless";
    return "no hardware adapter" + problems + ": " +
           (adapters[preferred].platform == Platform::surfaceless ? "surfaceless" : "software device");
}

std::optional<std::size_t> adapterOfIndex(std::span<const Adapter> adapters, std::string_view asked) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(asked.data(), asked.data() + asked.size(), index);
    if (error != std::errc() || end != asked.data() + asked.size() || index >= adapters.size()) return std::nullopt;
    return index;
}

std::size_t findAdapter(std::span<const Adapter> adapters, std::string_view asked) {
    if (const auto index = adapterOfIndex(adapters, asked)) return *index;
    const std::string wanted = lowerCase(asked);
    // A number only ever means an index: `--adapter 5` must not match `LLVM 15`.
    const bool isNumber = !asked.empty() && asked.find_first_not_of("0123456789") == std::string_view::npos;
    std::vector<std::size_t> equal, found;
    for (std::size_t i = 0; i < adapters.size() && !isNumber; ++i) {
        const std::string name = lowerCase(adapters[i].name);
        if (name == wanted) equal.push_back(i);
        if (name.find(wanted) != std::string::npos) found.push_back(i);
    }
    if (equal.size() == 1) return equal.front();
    if (found.size() == 1) return found.front();
    throw InputError("--adapter: got '" + std::string(asked) + "', which " +
                     (found.empty() ? "matches none" : "matches several") +
                     " of this machine's adapters; allowed: an index or part of a name: " + listed(adapters));
}

std::string problemsOf(std::span<const Adapter> adapters) {
    std::string text;
    for (const Adapter& adapter : adapters)
        if (!adapter.problem.empty()) text += (text.empty() ? "" : "; ") + adapter.name + " " + adapter.problem;
    return text;
}

}  // namespace dustbench::gpu
