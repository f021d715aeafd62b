// A compute shader has no fragment: its pixel is the place of its invocation in rows of 64.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"

#define gl_FragCoord vec4(vec2(gl_GlobalInvocationID.x % 64, gl_GlobalInvocationID.x / 64) + 0.5, 0.0, 1.0)
#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/pixel.glsl"
#include "shared/samples.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    Ray ray = load_ray();
    uint index = uint(arguments.values[i].x);
    Place place = place_at(ray, steps_to(index));
    results.values[4 * i] = vec4(ray.steps, float(ray.samples), 0.0, 0.0);
    results.values[4 * i + 1] = vec4(position_at(ray, steps_to(index)), 0.0);
    results.values[4 * i + 2] = vec4(place.below, 0.0);
    results.values[4 * i + 3] = vec4(place.weight, 0.0);
}
