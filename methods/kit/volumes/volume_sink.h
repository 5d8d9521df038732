// Receives a volume value by value while it is read, so that the reader need not store all of it.
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

    /// Called once, before the fields.
    virtual void begin(const GridPlace& place) = 0;
    /// `density`, `temperature` or `velocity`, in this order. Returns false to skip the field's values.
    virtual bool beginField(std::string_view field) = 0;
    /// The field's next values: cell by cell, x fastest; three per cell for a velocity.
    virtual void take(std::span<const float> numbers) = 0;
};

}  // namespace dustbench::volumes
