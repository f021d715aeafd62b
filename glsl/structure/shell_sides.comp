// Which side of a level the nodes of a lattice are on: a bit where the value is not below it, 32 nodes of a row in a word, one word an
// invocation. Twin: src/scene/shells/lattice.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/shell_lattice.glsl"

layout(set = 0, binding = 3) uniform sampler3D volume;
layout(set = 0, binding = 37, std430) writeonly buffer ShellSides {
    uint words[];
} shell_sides;

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    Word word = word_at(index);
    ivec3 last = textureSize(volume, 0) - 1;
    uint bits = 0u;
    if (word.y > 0u && word.y + 1u < slice.cells_y && word.z > 0u && word.z + 1u < slice.cells_z) {
        uint begin = max(word.at * 32u, 1u);
        uint end = min(word.at * 32u + 32u, slice.cells_x - 1u);
        for (uint x = begin; x < end; ++x) {
            ivec3 voxel = clamp(ivec3(x, word.y, word.z) - MARGIN, ivec3(0), last);
            bits |= uint(texelFetch(volume, voxel, 0).r >= slice.threshold) << (x & 31u);
        }
    }
    shell_sides.words[index] = bits;
}
