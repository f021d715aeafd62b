#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"
#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/polygon.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 pixel = arguments.values[i].xy;
    Meeting found = meet(uint(arguments.values[i].z), pixel);
    vec2 way = df_add(found.depth, -box_interval(pixel, view_ray(pixel)).enter);
    results.values[i] = vec4(way.x * found.stretch, frame.near / found.depth.x, found.shown ? 1.0 : 0.0, found.front ? 1.0 : 0.0);
}
