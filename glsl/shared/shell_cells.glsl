// Which cells of a lattice a level crosses, and how. The Rust side is src/scene/shells/crossings.rs.

#include "shared/shell_lattice.glsl"

layout(set = 0, binding = 37, std430) readonly buffer ShellSides {
    uint words[];
} shell_sides;
// Of each case: four bits for each edge of its triangles, and in the last four their number.
layout(set = 0, binding = 40, std430) readonly buffer ShellCases {
    uvec2 edges[];
} shell_cases;
#ifdef HOLES
layout(set = 0, binding = 4) uniform usampler3D holes;

// Whether the cell that goes up from a node is a hole.
bool is_hole(ivec3 node) {
    return texelFetch(holes, clamp(node - MARGIN, ivec3(0), textureSize(holes, 0) - 1), 0).r != 0u;
}
#endif

uint sides(Word word) {
    return shell_sides.words[index_of(word)];
}

// The sides of the nodes one further along x.
uint next_sides(Word word) {
    uint last = word.at + 1u < words(slice.cells_x) ? sides(Word(word.at + 1u, word.y, word.z)) << 31 : 0u;
    return sides(word) >> 1 | last;
}

// The nodes of a word that have a neighbour along x.
uint with_next(Word word) {
    uint before = word.at * 32u + 1u;
    uint nodes = slice.cells_x > before ? slice.cells_x - before : 0u;
    return nodes >= 32u ? 0xFFFFFFFFu : (1u << nodes) - 1u;
}

// The cells of a word that the level crosses, and the sides of their corners.
uint crossed_cells(Word word, out uint corners[8]) {
    corners = uint[8](0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    if (word.y + 1u >= slice.cells_y || word.z + 1u >= slice.cells_z) {
        return 0u;
    }
    uint any = 0u;
    uint all = 0xFFFFFFFFu;
    for (uint row = 0u; row < 4u; ++row) {
        Word of = Word(word.at, word.y + (row & 1u), word.z + (row >> 1));
        corners[2u * row] = sides(of);
        corners[2u * row + 1u] = next_sides(of);
        any |= corners[2u * row] | corners[2u * row + 1u];
        all &= corners[2u * row] & corners[2u * row + 1u];
    }
    return any & ~all & with_next(word);
}

// The case of a cell of a word.
uvec2 case_of(uint corners[8], uint bit) {
    uint number = 0u;
    for (uint corner = 0u; corner < 8u; ++corner) {
        number |= (corners[corner] >> bit & 1u) << corner;
    }
    return shell_cases.edges[number];
}

// The triangles of a case.
uint triangles_of(uvec2 edges) {
    return edges.y >> 28;
}
