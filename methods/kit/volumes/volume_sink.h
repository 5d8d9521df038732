// Takes a volume number by number while it is read, so that who reads need not hold all of it.
//
// Units and frame: the file's own.
#pragma once

#include <span>
#include <string_view>

#include "methods/kit/volumes/grid_place.h"

namespace dustbench::volumes {

class VolumeSink {
 public:
    virtual ~VolumeSink() = default;

    /// Comes first, once.
    virtual void begin(const GridPlace& place) = 0;
    /// `density`, `temperature` or `velocity`, in this order; false: its numbers are not wanted.
    virtual bool beginField(std::string_view field) = 0;
    /// The field's next numbers: cell by cell, x fastest; three a cell of a velocity.
    virtual void take(std::span<const float> numbers) = 0;
};

}  // namespace dustbench::volumes
