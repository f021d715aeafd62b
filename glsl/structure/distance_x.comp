// Distance transform, first axis: squared box distance from every cell to the nearest interesting one of its row, found
// in the bits. One word of 32 cells an invocation. Twin: src/structure/distance.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [ONE_SIDED]

#include "shared/slice.glsl"
#include "shared/square.glsl"

layout(set = 0, binding = 12, std430) readonly buffer Interesting {
    uint words[];
} interesting;
layout(set = 0, binding = 13, std430) writeonly buffer Squares {
    uint squares[];
} squares;

// Cells to a place that is not there.
const int NEVER = 1 << 20;

// The first interesting cell behind word `word` of the row that begins at `row_begin`, as far as it matters.
int first_after(uint row_begin, uint word, uint in_row) {
    uint end = min(in_row, word + 2u + slice.reach / 32u);
    for (uint w = word + 1u; w < end; ++w) {
        uint bits = interesting.words[row_begin + w];
        if (bits != 0u) {
            return int(w * 32u) + findLSB(bits);
        }
    }
    return NEVER;
}

// The last one before it.
int last_before(uint row_begin, uint word) {
    uint begin = word - min(word, 1u + slice.reach / 32u);
    for (uint w = word; w > begin; --w) {
        uint bits = interesting.words[row_begin + w - 1u];
        if (bits != 0u) {
            return int(w * 32u) - 32 + findMSB(bits);
        }
    }
    return -NEVER;
}

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint in_row = words(slice.cells_x);
    uint row = index / in_row;
    uint word = index % in_row;
    uint bits = interesting.words[index];
    int begin = int(word * 32u);
    uint count = min(32u, slice.cells_x - word * 32u);
#ifdef ONE_SIDED
    bool up = (slice.octant & 1u) == 0u;
    bool down = !up;
#else
    const bool up = true;
    const bool down = true;
#endif
    int after = up ? first_after(row * in_row, word, in_row) : NEVER;
    int before = down ? last_before(row * in_row, word) : -NEVER;
    uint out_begin = row * slice.cells_x + word * 32u;
    for (uint i = 0u; i < count; ++i) {
        int x = begin + int(i);
        uint above = bits >> i;
        uint below = bits << (31u - i);
        int up_to = !up ? NEVER : (above != 0u ? findLSB(above) : after - x);
        int down_to = !down ? NEVER : (below != 0u ? 31 - findMSB(below) : x - before);
        // Between boxes: one cell less than between indices.
        uint between = uint(max(min(up_to, down_to) - 1, 0));
        squares.squares[out_begin + i] = square_of(between, slice.weight, slice.reach);
    }
}
