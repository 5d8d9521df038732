#include "bench/cli/slurm_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/page_template.h"
#include "bench/results/shell_words.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::cli {
namespace {

/// Overhead of starting a run, and of a shard. The values are generous, because a task that Slurm kills loses a run,
/// while one that ends early costs nothing.
constexpr double secondsAroundRun = 15, secondsAroundShard = 120;

/// Letters, digits and a few characters without a special meaning for Slurm, which interprets % in file names.
std::string plainName(const std::string& text) {
    std::string plain = text;
    std::ranges::replace_if(
        plain,
        [](char letter) {
            return !std::isalnum(static_cast<unsigned char>(letter)) && letter != '-' && letter != '_' && letter != '.';
        },
        '_');
    return plain;
}

/// `1-02:30:00`
std::string slurmTime(double seconds) {
    const auto minutes = static_cast<long long>(std::ceil(seconds / 60));
    return fmt::format("{}-{:02}:{:02}:00", minutes / (24 * 60), minutes / 60 % 24, minutes % 60);
}

}  // namespace

std::vector<std::string> withoutOptions(const std::vector<std::string>& words,
                                        const std::vector<std::string>& options) {
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string name = words[i].substr(0, words[i].find('='));
        if (std::ranges::find(options, name) == options.end())
            rest.push_back(words[i]);
        else if (name == words[i])
            ++i;
    }
    return rest;
}

std::string slurmScript(const SlurmJob& job) {
    const double around = secondsAroundRun + job.cooldownSeconds;
    const double seconds =
        secondsAroundShard + static_cast<double>(job.maximumRunsOfShard) * (job.timeoutSeconds + around);
    std::string arguments;
    for (const std::string& word : job.arguments) arguments += " " + bench::shellQuoted(word);
    const std::filesystem::path file = files::dataPath("templates/slurm.sh");
    if (file.empty()) throw InputError("data: the file templates/slurm.sh is missing");
    return bench::filled(files::wholeText(file, "template"), {{"name", plainName(job.name)},
                                                              {"shards", std::to_string(job.shards)},
                                                              {"time", slurmTime(seconds)},
                                                              {"runs", std::to_string(job.runs)},
                                                              {"most", std::to_string(job.maximumRunsOfShard)},
                                                              {"timeout", fmt::format("{:g}", job.timeoutSeconds)},
                                                              {"around", fmt::format("{:g}", around)},
                                                              {"extra", fmt::format("{:g}", secondsAroundShard)},
                                                              {"program", bench::shellQuoted(job.program)},
                                                              {"folder", bench::shellQuoted(job.folder)},
                                                              {"out", bench::shellQuoted(job.out)},
                                                              {"arguments", arguments}});
}

}  // namespace dustbench::cli
