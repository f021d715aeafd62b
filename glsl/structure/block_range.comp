// Value range of every block of 8^3 cells, 9^3 voxels, since interpolation reaches the neighbour [KW03 §2.3].
// One invocation a block. Twin: src/structure/blocks.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

#include "shared/block.glsl"

layout(set = 0, binding = 3) uniform sampler3D volume;
layout(set = 0, binding = 8, std430) writeonly buffer BlockRange {
    vec2 ranges[];
} block_range;

void main() {
    ivec3 dims = textureSize(volume, 0);
    ivec3 blocks = block_count(dims);
    ivec3 block = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(block, blocks))) {
        return;
    }
    ivec3 begin = block * BLOCK;
    ivec3 end = min(begin + BLOCK, dims - 1);
    vec2 range = vec2(texelFetch(volume, begin, 0).r);
    for (int z = begin.z; z <= end.z; ++z) {
        for (int y = begin.y; y <= end.y; ++y) {
            for (int x = begin.x; x <= end.x; ++x) {
                float value = texelFetch(volume, ivec3(x, y, z), 0).r;
                range = vec2(min(range.x, value), max(range.y, value));
            }
        }
    }
    block_range.ranges[(block.z * blocks.y + block.y) * blocks.x + block.x] = range;
}
