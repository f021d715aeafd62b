#version 460
#extension GL_GOOGLE_include_directive : require

#define COMPUTE
#define SINGLE_RAYS
#include "../tests/device/formulas/arguments.glsl"
#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 pixel = arguments.values[i].xy;
    ViewRay ray = view_ray(pixel);
    Interval interval = box_interval(pixel, ray);
    vec3 begin = entry_at(ray, interval);
    results.values[2 * i] = vec4(begin, 0.0);
    results.values[2 * i + 1] = direction_from(ray, interval, begin);
}
