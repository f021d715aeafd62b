// The first place of a ray at which the field has a value, between two places: steps, and how many voxels that is.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"

#define gl_FragCoord vec4(vec2(gl_GlobalInvocationID.x % 64, gl_GlobalInvocationID.x / 64) + 0.5, 0.0, 1.0)
#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/pixel.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/root.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 asked = arguments.values[i];
    Ray ray = load_ray();
    results.values[i] = vec4(first_at(ray, asked.xy, asked.z, asked.w), 0.0, 0.0, 0.0);
}
