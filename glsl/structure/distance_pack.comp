// Squares to bytes: 0 for interesting cells, for others one more than the distance in whole voxels, rounded down with
// slack; rows of whole words. One word an invocation. Twin: src/structure/distance.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/slice.glsl"
#include "shared/square.glsl"

layout(set = 0, binding = 12, std430) readonly buffer Interesting {
    uint words[];
} interesting;
layout(set = 0, binding = 13, std430) readonly buffer Squares {
    uint squares[];
} squares;
layout(set = 0, binding = 14, std430) writeonly buffer DistanceBytes {
    uint words[];
} distance_bytes;

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint in_row = (slice.cells_x + 3u) / 4u;
    uint begin = index % in_row * 4u;
    uint end = min(begin + 4u, slice.cells_x);
    uint row = index / in_row;
    // The four cells' bits are in one word.
    uint bits = interesting.words[row * words(slice.cells_x) + begin / 32u] >> (begin & 31u);
    uint word = 0u;
    for (uint x = begin; x < end; ++x) {
        uint byte = (bits >> (x - begin) & 1u) != 0u ? 0u : free_voxels(squares.squares[row * slice.cells_x + x]) + 1u;
        word |= byte << (8u * (x - begin));
    }
    distance_bytes.words[index] = word;
}
