// The options by which `export`, `run` and `suite` say which volumes they write.
#pragma once

#include <optional>
#include <string>

#include "bench/cli/arguments.h"
#include "bench/export/volume_settings.h"

namespace dustbench::cli {

class VolumeOptions {
 public:
    /// `framesName` is `--frames` where frames must be given, or `--volumes` where none means no volumes.
    explicit VolumeOptions(std::string framesName) : framesName_(std::move(framesName)) {}

    void declareRequired(Arguments& arguments);
    void declareOptional(Arguments& arguments);
    /// What was given, over `base` where that has something. None: no volumes. Throws InputError, also where a format
    /// or the like is given without frames.
    [[nodiscard]] std::optional<bench::VolumeSettings> over(const std::optional<bench::VolumeSettings>& base) const;

 private:
    void declareRest(Arguments& arguments);

    std::string framesName_;
    std::string frames_, formats_, resolution_, region_, precision_;
};

}  // namespace dustbench::cli
