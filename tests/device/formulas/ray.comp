#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"
#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 pixel = arguments.values[i].xy;
    ViewRay ray = view_ray(pixel);
    Interval interval = box_interval(pixel, ray);
    results.values[4 * i] = vec4(interval.enter, interval.leave);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 enter = texture_coordinate(ray, interval.enter, axis, interval.enter_axis, false);
        vec2 leave = texture_coordinate(ray, interval.leave, axis, interval.leave_axis, true);
        results.values[4 * i + 1 + axis] = vec4(enter, leave);
    }
}
