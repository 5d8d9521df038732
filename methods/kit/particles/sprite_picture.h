// The picture of a sprite: a Gaussian, or a picture of data/textures.
#pragma once

#include <string>

#include "methods/contract/parameters.h"

namespace dustbench::particles {

/// Declares `picture`.
void declarePicture(ParameterSet& set);
/// Returns the picture's name; empty for the Gaussian.
[[nodiscard]] std::string pictureOf(const ParameterValues& values);

}  // namespace dustbench::particles
