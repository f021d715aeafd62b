// The whole way of a ray through cells in one loop. Twin: src/twin/tetrahedra.rs.

#include "shared/tet_cell.glsl"

// The faces by which rays enter, as tet_enter.frag has them.
layout(set = 0, binding = 66) uniform sampler2D tet_entry;

// Of each face of the boundary its side.
layout(set = 0, binding = 64, std430) readonly buffer TetBoundary {
    uvec4 list[];
} tet_boundary;

// Whether a ray needs no further cells.
#ifdef ENDLESS
#define IS_ENDED(held) false
#else
#define IS_ENDED(held) ended(held, 0.0)
#endif

// Where a ray enters; nowhere without a face.
Way entry_of(vec4 entered) {
    uint side = entered.y > 0.0 ? tet_boundary.list[uint(entered.y) - 1u].x : NOTHING;
    return Way(side, entered.zw);
}

// What a ray holds once it has entered.
vec4 begin_in_mesh() {
#ifdef VALUES
    return vec4(no_sample().rgb, 1.0);
#else
    return vec4(0.0);
#endif
}

// Goes on through cells from a face of the boundary to the next one, with what the ray holds.
vec4 through_cells(Line line, Way way, vec4 held) {
    while (way.side != NOTHING && !IS_ENDED(held)) {
        vec2 from = way.at;
        vec2 to;
        way = leave(line, way, to);
        held = joined(held, cell_light(line, from, to));
    }
    return held;
}
