// Value range of every cell of a grid: of all voxels that its cells interpolate, the neighbours' first ones included.
// With a side of 8 these are the blocks of [KW03 §2.3]. Depends on the volume alone. Twin: src/structure/blocks.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/slice.glsl"

layout(set = 0, binding = 3) uniform sampler3D volume;
layout(set = 0, binding = 8, std430) writeonly buffer CellRange {
    vec2 ranges[];
} cell_range;

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint row = index / slice.cells_x;
    ivec3 cell = ivec3(index % slice.cells_x, row % slice.cells_y, row / slice.cells_y);
    ivec3 begin = cell * int(slice.cell);
    ivec3 end = min(begin + int(slice.cell), textureSize(volume, 0) - 1);
    vec2 range = vec2(texelFetch(volume, begin, 0).r);
    for (int z = begin.z; z <= end.z; ++z) {
        for (int y = begin.y; y <= end.y; ++y) {
            for (int x = begin.x; x <= end.x; ++x) {
                float value = texelFetch(volume, ivec3(x, y, z), 0).r;
                range = vec2(min(range.x, value), max(range.y, value));
            }
        }
    }
    cell_range.ranges[index] = range;
}
