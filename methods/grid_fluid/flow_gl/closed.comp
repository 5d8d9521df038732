// Subtracts the mean of the right-hand side in each closed region; one group of threads per region.
layout(std430, binding = 4) restrict buffer RightSide { float rightSide[]; };
layout(std430, binding = 5) restrict readonly buffer Runs { ivec4 runs[]; };  // i, end, j, k
layout(std430, binding = 6) restrict readonly buffer Regions { ivec2 regions[]; };  // first run, end of runs
layout(std430, binding = 7) restrict buffer Report { uint report[]; };
uniform int slot, regionCount;

shared double sums[GROUP];
shared int counts[GROUP];

void main() {
    int own = int(gl_LocalInvocationIndex);
    bool exists = groupNumber() < regionCount;
    ivec2 region = exists ? regions[groupNumber()] : ivec2(0);
    double sum = 0.0lf;
    int count = 0;
    for (int r = region.x + own; r < region.y; r += GROUP) {
        ivec4 run = runs[r];
        float ofRun = 0.0;
        for (int i = run.x; i < run.y; ++i) ofRun += rightSide[place(ivec3(i, run.zw))];
        sum += double(ofRun);
        count += run.y - run.x;
    }
    sums[own] = sum;
    counts[own] = count;
    for (int width = GROUP / 2; width > 0; width /= 2) {
        barrier();
        if (own < width) {
            sums[own] += sums[own + width];
            counts[own] += counts[own + width];
        }
    }
    barrier();
    float mean = float(sums[0] / double(counts[0]));
    for (int r = region.x + own; r < region.y; r += GROUP) {
        ivec4 run = runs[r];
        for (int i = run.x; i < run.y; ++i) rightSide[place(ivec3(i, run.zw))] -= mean;
    }
    if (own == 0 && exists) atomicMax(report[slot], floatBitsToUint(mean) & 0x7fffffffu);
}
