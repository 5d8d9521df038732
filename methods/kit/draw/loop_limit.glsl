// Whether the driver has ended this invocation's loops early (loop_limit.h). Costs a few iterations; call it once, at the end.
uniform int probeIterations;  // more than one, unknown to the compiler
layout(std430, binding = 6) buffer Unfinished {
    uint unfinished;  // pixels
};

bool isCutShort() {
    int iterations = 0;
    while (iterations < probeIterations) ++iterations;
    return iterations < probeIterations;
}
