// How many vertices and triangles come before each of 64 entries, and how many all of them have: an invocation sums up 64 of them. Run once
// more over those sums, and so on, until one invocation has summed up all. Twin: src/scene/shells/crossings.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/shell_lattice.glsl"

layout(set = 0, binding = 39, std430) buffer ShellSums {
    uvec2 sums[];
} shell_sums;

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint end = min((index + 1u) * SUMMED, slice.stride);
    uvec2 before = uvec2(0u);
    for (uint i = index * SUMMED; i < end; ++i) {
        uvec2 here = shell_sums.sums[slice.inner + i];
        shell_sums.sums[slice.inner + i] = before;
        before += here;
    }
    shell_sums.sums[slice.outer + index] = before;
}
