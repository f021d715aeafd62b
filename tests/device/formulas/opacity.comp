#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"
#include "shared/opacity.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 a = arguments.values[3 * i];
    results.values[2 * i] = vec4(corrected_opacity(a.x, 1.0 - a.x, a.y), log_1_plus(a.z), exp_minus_1(a.w), 0.0);
    results.values[2 * i + 1] = composite(arguments.values[3 * i + 1], arguments.values[3 * i + 2]);
}
