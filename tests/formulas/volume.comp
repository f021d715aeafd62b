#version 460
#extension GL_GOOGLE_include_directive : require

#include "../tests/formulas/arguments.glsl"
#include "shared/frame.glsl"
#include "shared/cell.glsl"
#include "shared/volume.glsl"
#include "shared/transfer.glsl"
#include "shared/block.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 a = arguments.values[i];
    ivec3 cell = cell_at(a.xyz);
    results.values[3 * i] = vec4(cell, sample_volume(a.xyz));
    results.values[3 * i + 1] = classify(a.w);
    ivec2 codes = range_codes(a.xw);
    results.values[3 * i + 2] = vec4(codes, block_count(ivec3(frame.dims.xyz)).xy);
}
