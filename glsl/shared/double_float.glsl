// Double-float arithmetic: a number is vec2(high, low), their unevaluated sum, about 48 significant bits.
// Rays are set up in it once a pixel, so that sample positions are as good as an f32 can hold them.
// Source: Dekker 1971, Knuth TAOCP vol. 2 (two-sum). Products are Dekker's too, since `fma` need not be fused and on
// some drivers is not. `precise` keeps a compiler from simplifying the error terms away.

vec2 two_sum(float a, float b) {
    precise float sum = a + b;
    precise float part = sum - a;
    precise float rest = sum - part;
    precise float error = (a - rest) + (b - part);
    return vec2(sum, error);
}

// The leading bits of a number, all but the last `cleared` of its 24.
float leading(float a, int cleared) {
    return uintBitsToFloat(floatBitsToUint(a) & (0xffffffffu << cleared));
}

// Halves of 12 bits, whose products are exact.
vec2 two_product(float a, float b) {
    precise float a_high = leading(a, 12);
    precise float b_high = leading(b, 12);
    precise float a_low = a - a_high;
    precise float b_low = b - b_high;
    precise float product = a * b;
    precise float error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    return vec2(product, error);
}

// The sum of a number and one that is no larger.
vec2 sum_of_smaller(float a, float b) {
    precise float sum = a + b;
    precise float error = b - (sum - a);
    return vec2(sum, error);
}

vec2 df_add(vec2 a, vec2 b) {
    vec2 sum = two_sum(a.x, b.x);
    precise float low = sum.y + (a.y + b.y);
    return sum_of_smaller(sum.x, low);
}

vec2 df_multiply(vec2 a, vec2 b) {
    vec2 product = two_product(a.x, b.x);
    precise float cross = a.x * b.y + a.y * b.x;
    precise float low = product.y + cross;
    return sum_of_smaller(product.x, low);
}

vec2 df_divide(vec2 a, vec2 b) {
    precise float first = a.x / b.x;
    vec2 product = two_product(first, b.x);
    // The first difference is exact: the quotient is rounded once.
    precise float rest = ((a.x - product.x) - product.y) + (a.y - first * b.y);
    return sum_of_smaller(first, rest / b.x);
}

// Of a positive number: the root of the high part, and one step of Newton's for what it leaves.
vec2 df_sqrt(vec2 a) {
    precise float first = sqrt(a.x);
    vec2 square = two_product(first, first);
    precise float rest = ((a.x - square.x) - square.y) + a.y;
    return sum_of_smaller(first, rest / (2.0 * first));
}

bool df_less(vec2 a, vec2 b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}
