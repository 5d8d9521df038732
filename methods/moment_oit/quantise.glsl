// Moments of a measure of total 1, b[1..MOMENTS], as numbers in 0..1, and back. The matrices are by rows.
// The reference implementation is moment_kind.cpp. Source: Munstermann2018, supplement.
#ifdef TRIGONOMETRIC
void quantise(float b[MOMENTS + 1], out float q[MOMENTS]) {
    for (int j = 0; j < MOMENTS; ++j) q[j] = 0.5 * b[j + 1] + 0.5;
}
void dequantise(float q[MOMENTS], out float b[MOMENTS + 1]) {
    b[0] = 1.0;
    for (int j = 0; j < MOMENTS; ++j) b[j + 1] = 2.0 * q[j] - 1.0;
}
#else
void quantise(float b[MOMENTS + 1], out float q[MOMENTS]) {
    const int n = MOMENTS / 2;
    const float odd[n * n] = float[](QUANTISE_ODD), even[n * n] = float[](QUANTISE_EVEN);
    const float addedToOdd[n] = float[](OFFSET_ODD), addedToEven[n] = float[](OFFSET_EVEN);
    for (int i = 0; i < n; ++i) {
        q[2 * i] = addedToOdd[i];
        q[2 * i + 1] = addedToEven[i];
        for (int j = 0; j < n; ++j) {
            q[2 * i] += odd[i * n + j] * b[2 * j + 1];
            q[2 * i + 1] += even[i * n + j] * b[2 * j + 2];
        }
    }
}
void dequantise(float q[MOMENTS], out float b[MOMENTS + 1]) {
    const int n = MOMENTS / 2;
    const float odd[n * n] = float[](DEQUANTISE_ODD), even[n * n] = float[](DEQUANTISE_EVEN);
    const float addedToOdd[n] = float[](OFFSET_ODD), addedToEven[n] = float[](OFFSET_EVEN);
    b[0] = 1.0;
    for (int i = 0; i < n; ++i) {
        b[2 * i + 1] = 0.0;
        b[2 * i + 2] = 0.0;
        for (int j = 0; j < n; ++j) {
            b[2 * i + 1] += odd[i * n + j] * (q[2 * j] - addedToOdd[j]);
            b[2 * i + 2] += even[i * n + j] * (q[2 * j + 1] - addedToEven[j]);
        }
    }
}
#endif
