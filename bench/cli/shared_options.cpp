#include "bench/cli/shared_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "bench/results/input_files.h"
#include "bench/run/dust_place.h"
#include "bench/scene/world.h"
#include "bench/suite/value_list.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::cli {

bench::ParameterLists parseParameters(const std::vector<std::string>& texts) {
    bench::ParameterLists lists;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos) throw InputError("-P: got '" + text + "', expected name=value");
        const std::string name = text.substr(0, equals);
        if (std::ranges::find(lists, name, &bench::ParameterLists::value_type::first) != lists.end())
            throw InputError("-P: parameter " + name + " is given twice; for several values, use a list: " + name +
                             "=a,b");
        lists.emplace_back(name, bench::expandValues(name, text.substr(equals + 1)));
    }
    return lists;
}

void checkWorlds(const std::vector<bench::PlannedRun>& plan) {
    std::set<std::tuple<std::string, std::string, bench::ParameterTexts, std::string>> seen;
    for (const bench::PlannedRun& run : plan) {
        const auto parameters = bench::resolveParameters(findMethod(run.spec.method), run.spec.parameters);
        (void)bench::dataFilesOf(parameters.method);
        const std::string dust = fmt::format("{}\n{}\n{}\n{}", run.spec.dust, run.spec.dustColumns, run.spec.frames,
                                             bench::dustPlaces.wordOf(run.spec.dustOn));
        if (!seen.emplace(run.spec.scene, run.spec.drive, parameters.world.canonical(), dust).second) continue;
        bench::World loads(run.spec.scene, run.spec.drive, parameters.world, run.spec.seed);
        loads.useDust(bench::givenDust(run.spec));
        bench::requireDustPlace(run.spec, loads);
    }
}

}  // namespace dustbench::cli
