// The options of `export`, `run` and `suite` that select volumes.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "bench/cli/arguments.h"
#include "bench/export/volume_settings.h"

namespace dustbench::cli {

class VolumeOptions {
 public:
    /// `framesName` is `--frames` if frames are mandatory, or `--volumes` if volumes are optional.
    explicit VolumeOptions(std::string framesName) : framesName_(std::move(framesName)) {}

    void declareRequired(Arguments& arguments);
    void declareOptional(Arguments& arguments);
    /// The given options, with `base` as default. Empty: no volumes. Throws InputError, also if another volume option
    /// is given without frames.
    [[nodiscard]] std::optional<bench::VolumeSettings> over(const std::optional<bench::VolumeSettings>& base) const;

 private:
    void declareRest(Arguments& arguments);

    std::string framesName_;
    std::string frames_, formats_, resolution_, region_;
    std::map<std::string, std::string> options_;  ///< of formats, by id
};

}  // namespace dustbench::cli
