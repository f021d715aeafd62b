// Double-float arithmetic: a number is vec2(high, low), their unevaluated sum, about 48 significant bits.
// Rays are set up in it once a pixel, so that sample positions are as good as an f32 can hold them.
// Source: Dekker 1971 (split, product), Knuth TAOCP vol. 2 (two-sum). Not by fma: some drivers, Mesa's lavapipe among
// them, round its product, and the error that is asked for comes out 0.
// `precise` keeps a compiler from simplifying the error terms away.

vec2 two_sum(float a, float b) {
    precise float sum = a + b;
    precise float part = sum - a;
    precise float rest = sum - part;
    precise float error = (a - rest) + (b - part);
    return vec2(sum, error);
}

// Two halves of at most 12 bits, whose products are exact.
vec2 split(float a) {
    const float SHIFT = 4097.0; // 2^12 + 1
    precise float shifted = SHIFT * a;
    precise float rest = shifted - a;
    precise float high = shifted - rest;
    precise float low = a - high;
    return vec2(high, low);
}

vec2 two_product(float a, float b) {
    vec2 p = split(a);
    vec2 q = split(b);
    precise float product = a * b;
    precise float error = ((p.x * q.x - product) + p.x * q.y + p.y * q.x) + p.y * q.y;
    return vec2(product, error);
}

vec2 df_add(vec2 a, vec2 b) {
    vec2 sum = two_sum(a.x, b.x);
    precise float low = sum.y + (a.y + b.y);
    return two_sum(sum.x, low);
}

vec2 df_multiply(vec2 a, vec2 b) {
    vec2 product = two_product(a.x, b.x);
    precise float cross = a.x * b.y + a.y * b.x;
    precise float low = product.y + cross;
    return two_sum(product.x, low);
}

vec2 df_divide(vec2 a, vec2 b) {
    float first = a.x / b.x;
    vec2 rest = df_add(a, -df_multiply(vec2(first, 0.0), b));
    float second = rest.x / b.x;
    return two_sum(first, second);
}

bool df_less(vec2 a, vec2 b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}
