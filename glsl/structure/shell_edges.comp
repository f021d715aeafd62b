// Which edges of a lattice have a vertex: those that the level crosses, unless all cells around them are holes. And how many vertices and
// triangles the nodes and cells of a word have; one word an invocation. Twin: src/scene/shells/crossings.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [HOLES]

#include "shared/shell_cells.glsl"

layout(set = 0, binding = 38, std430) writeonly buffer ShellEdges {
    // Along x, y and z.
    uint words[];
} shell_edges;
layout(set = 0, binding = 39, std430) writeonly buffer ShellSums {
    uvec2 sums[];
} shell_sums;

#ifdef HOLES
// Whether all cells around the edge that goes up from a node along an axis are holes.
bool is_amid_holes(ivec3 node, int axis) {
    ivec3 cells = ivec3(slice.cells_x, slice.cells_y, slice.cells_z) - 1;
    int b = (axis + 1) % 3;
    int c = (axis + 2) % 3;
    for (int i = 0; i < 4; ++i) {
        ivec3 cell = node;
        cell[b] -= i & 1;
        cell[c] -= i >> 1;
        bool there = cell[b] >= 0 && cell[b] < cells[b] && cell[c] >= 0 && cell[c] < cells[c];
        if (there && !is_hole(cell)) {
            return false;
        }
    }
    return true;
}
#endif

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    Word word = word_at(index);
    uint here = sides(word);
    uvec3 crossed = uvec3((here ^ next_sides(word)) & with_next(word), 0u, 0u);
    if (word.y + 1u < slice.cells_y) {
        crossed.y = here ^ sides(Word(word.at, word.y + 1u, word.z));
    }
    if (word.z + 1u < slice.cells_z) {
        crossed.z = here ^ sides(Word(word.at, word.y, word.z + 1u));
    }
#ifdef HOLES
    for (int axis = 0; axis < 3; ++axis) {
        for (uint left = crossed[axis]; left != 0u; left &= left - 1u) {
            int bit = findLSB(left);
            if (is_amid_holes(ivec3(int(word.at) * 32 + bit, word.y, word.z), axis)) {
                crossed[axis] &= ~(1u << bit);
            }
        }
    }
#endif
    uint corners[8];
    uint triangles = 0u;
    for (uint left = crossed_cells(word, corners); left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left));
#ifdef HOLES
        if (is_hole(ivec3(word.at * 32u + bit, word.y, word.z))) {
            continue;
        }
#endif
        triangles += triangles_of(case_of(corners, bit));
    }
    for (uint axis = 0u; axis < 3u; ++axis) {
        shell_edges.words[3u * index + axis] = crossed[axis];
    }
    ivec3 vertices = bitCount(crossed);
    shell_sums.sums[index] = uvec2(vertices.x + vertices.y + vertices.z, triangles);
}
