// The destructors of the contract's interfaces. Out of line, so that each interface has one vtable and one type, shared
// by all loaded libraries.
#include "methods/contract/experiment.h"
#include "methods/contract/method.h"
#include "methods/contract/stage_clock.h"
#include "methods/contract/volume.h"

namespace dustbench {

ExperimentContext::~ExperimentContext() = default;
ExperimentWorld::~ExperimentWorld() = default;
Method::~Method() = default;
StageListener::~StageListener() = default;
VolumeVisitor::~VolumeVisitor() = default;

}  // namespace dustbench
