/// Error function, absolute error below 3e-7. Source: AbramowitzStegun1964, Eq. 7.1.28.
float errorFunction(float x) {
    float a = min(abs(x), 6.0);
    float p = 0.0001520143 + a * (0.0002765672 + a * 0.0000430638);
    p = 1.0 + a * (0.0705230784 + a * (0.0422820123 + a * (0.0092705272 + a * p)));
    float p4 = (p * p) * (p * p);
    return sign(x) * (1.0 - 1.0 / ((p4 * p4) * (p4 * p4)));
}
