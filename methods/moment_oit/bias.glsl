uniform float momentBias;
uniform float overestimation;

/// Normalises, and moves a little towards the moments of a measure that is far from singular. Munstermann2018, 3.4.
void biased(inout float b[MOMENTS + 1]) {
    const float towards[MOMENTS] = float[](TOWARDS);
    for (int j = 1; j <= MOMENTS; ++j) b[j] = mix(b[j] / b[0], towards[j - 1], momentBias);
    b[0] = 1.0;
}
