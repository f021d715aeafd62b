// The natural logarithm of a number above 0: those of drivers have too few digits.

// `over_one` is what the number is more than 1, which may be known to more digits than it has itself.
float logarithm(float number, float over_one) {
    int bits = floatBitsToInt(number);
    int exponent = (bits >> 23) - 127;
    float mantissa = intBitsToFloat((bits & 0x7FFFFF) | 0x3F800000);
    if (mantissa > 1.41421356) {
        mantissa *= 0.5;
        exponent += 1;
    }
    float ratio = (exponent == 0 ? over_one : mantissa - 1.0) / (mantissa + 1.0);
    float square = ratio * ratio;
    float series = 1.0 + square * ((1.0 / 3.0 + square * (1.0 / 5.0)) + square * square * (1.0 / 7.0 + square * (1.0 / 9.0)));
    return float(exponent) * 0.69314718 + 2.0 * ratio * series;
}

float logarithm(float number) {
    return logarithm(number, number - 1.0);
}
