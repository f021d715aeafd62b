// Interesting cells seen through a window: from bits that stand for windows of some width, those of windows `reach`
// cells wider along each axis. One word an invocation. Twin: src/structure/wide.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/slice.glsl"

layout(set = 0, binding = 12, std430) readonly buffer Narrow {
    uint words[];
} narrow;
layout(set = 0, binding = 13, std430) writeonly buffer Wide {
    uint words[];
} wide;

// Word `word` of the rows (y, z), where it is in the row.
uint any_of(uint word, uint in_row, uvec2 y, uvec2 z) {
    if (word >= in_row) {
        return 0u;
    }
    return narrow.words[(z.x * slice.cells_y + y.x) * in_row + word]
         | narrow.words[(z.x * slice.cells_y + y.y) * in_row + word]
         | narrow.words[(z.y * slice.cells_y + y.x) * in_row + word]
         | narrow.words[(z.y * slice.cells_y + y.y) * in_row + word];
}

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint in_row = words(slice.cells_x);
    uint row = index / in_row;
    uvec2 y = min(row % slice.cells_y + uvec2(0u, slice.reach), uvec2(slice.cells_y - 1u));
    uvec2 z = min(row / slice.cells_y + uvec2(0u, slice.reach), uvec2(slice.cells_z - 1u));
    uint here = any_of(index % in_row, in_row, y, z);
    uint after = any_of(index % in_row + 1u, in_row, y, z);
    wide.words[index] = here | here >> slice.reach | after << (32u - slice.reach);
}
