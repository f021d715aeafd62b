#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"
#include "shared/frame.glsl"
#include "shared/mark.glsl"
#include "shared/section.glsl"
#include "shared/free.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 a = arguments.values[i];
    uint section = uint(a.x);
    uint free = free_samples(a.y, 1.0);
    results.values[i] = vec4(section_depth(section, false), section_depth(section, true), float(free), DEAD);
}
