// Adds the groups' sums and tracks the expected density.
layout(local_size_x = GROUP) in;
layout(std430, binding = 2) restrict readonly buffer Sums { double sums[]; };
layout(std430, binding = 3) restrict buffer Balance {
    double covered, due;
    float scale;
};
uniform int what;  // as in density_sum.comp
uniform int count;

// Limits the effect of a wrong balance, for example if the whole cloud leaves at once.
const double maximumChange = 0.1lf;

shared double parts[GROUP];

void main() {
    int own = int(gl_LocalInvocationIndex);
    double sum = 0.0lf;
    for (int n = own; n < count; n += GROUP) sum += sums[n];
    parts[own] = sum;
    for (int width = GROUP / 2; width > 0; width /= 2) {
        barrier();
        if (own < width) parts[own] += parts[own + width];
    }
    if (own != 0) return;
    if (what == 2) {
        covered += parts[0];
    } else if (what == 1) {
        due = covered + parts[0];
        covered = 0.0lf;
    } else {
        scale = parts[0] > 0.0lf ? float(clamp(due / parts[0], 1.0lf - maximumChange, 1.0lf + maximumChange)) : 1.0;
    }
}
