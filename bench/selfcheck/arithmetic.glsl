// A chain of multiplications and additions that a compiler cannot shorten: two operations a round.
uniform int rounds;

float chain(float x) {
    for (int i = 0; i < rounds; ++i) x = x * 0.999 + 0.25;
    return x;
}
