// Part of every test program under ThreadSanitizer: oneTBB runs on one thread.
//
// Debian's oneTBB is not compiled with ThreadSanitizer, which does not see how its threads wait for each other and
// reports false races in OpenVDB's loops. Our own loops use plain threads there (methods/kit/parallel).
#include <tbb/global_control.h>

namespace {

const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);

}  // namespace
