// Opacity of a segment and front-to-back compositing. Twin: src/math/opacity.rs.

// ln(1 + x) for x in [-0.5, 0], as 2 artanh(x / (2 + x)), without the cancellation of the plain form.
float log_1_plus(float x) {
    float s = x / (2.0 + x);
    float q = s * s;
    float r = q * q;
    float series = fma(r * r, fma(q, 1.0 / 11.0, 1.0 / 9.0), fma(r, fma(q, 1.0 / 7.0, 0.2), fma(q, 1.0 / 3.0, 1.0)));
    return 2.0 * s * series;
}

// exp(x) - 1 for x in [-0.5, 0].
float exp_minus_1(float x) {
    float square = x * x;
    float low = fma(square, fma(x, 1.0 / 24.0, 1.0 / 6.0), fma(x, 0.5, 1.0));
    float high = fma(square, fma(x, 1.0 / 40320.0, 1.0 / 5040.0), fma(x, 1.0 / 720.0, 1.0 / 120.0));
    return x * fma(square * square, high, low);
}

// 1 - (1 - alpha)^exponent: opacity of a segment `exponent` reference lengths long; `clear` is 1 - alpha.
float corrected_opacity(float alpha, float clear, float exponent) {
    if (clear <= 0.0) {
        return exponent > 0.0 ? 1.0 : 0.0;
    }
    float optical_depth = -exponent * (alpha <= 0.5 ? log_1_plus(-alpha) : log(clear));
    return optical_depth <= 0.5 ? -exp_minus_1(-optical_depth) : 1.0 - exp(-optical_depth);
}

// Puts `behind` (premultiplied) under `front` [KW03 §1.1].
vec4 composite(vec4 front, vec4 behind) {
    return fma(vec4(1.0 - front.a), behind, front);
}
