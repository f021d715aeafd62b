#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"
#include "shared/double_float.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 a = arguments.values[i].xy;
    vec2 b = arguments.values[i].zw;
    results.values[3 * i] = vec4(two_sum(a.x, b.x), two_product(a.x, b.x));
    results.values[3 * i + 1] = vec4(df_add(a, b), df_multiply(a, b));
    results.values[3 * i + 2] = vec4(df_divide(a, b), df_less(a, b) ? 1.0 : 0.0, 0.0);
}
