// Squares to distances: whole voxels, rounded down with slack, a byte each, rows of whole words. One word an
// invocation. Twin: src/structure/distance.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/slice.glsl"
#include "shared/square.glsl"

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
    uint row = index / in_row * slice.cells_x;
    uint word = 0u;
    for (uint x = begin; x < end; ++x) {
        word |= free_voxels(squares.squares[row + x]) << (8u * (x - begin));
    }
    distance_bytes.words[index] = word;
}
