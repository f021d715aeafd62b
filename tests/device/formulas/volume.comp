#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/device/formulas/arguments.glsl"
// A compute shader has no fragment; no ray is loaded here.
#define gl_FragCoord vec4(0.0)
#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/pixel.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/transfer.glsl"
#include "shared/block.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 a = arguments.values[i];
    vec3 voxel = a.xyz * frame.dims.xyz - 0.5;
    Place place = Place(floor(voxel), voxel - floor(voxel));
    results.values[3 * i] = vec4(cell_of(place), sample_exact(place));
    float clear;
    results.values[3 * i + 1] = classify(a.w, clear);
    ivec2 codes = range_codes(a.xw);
    results.values[3 * i + 2] = vec4(codes, block_count(ivec3(frame.dims.xyz)).xy);
}
