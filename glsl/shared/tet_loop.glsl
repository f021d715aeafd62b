// The whole way of a ray through cells in one loop. Twin: src/twin/tetrahedra.rs.

#include "shared/tet_cell.glsl"
#include "shared/boundary.glsl"

// The faces by which rays enter, as tet_enter.frag has them.
layout(set = 0, binding = 66) uniform sampler2D tet_entry;

// Whether a ray needs no further cells.
#ifdef ENDLESS
#define IS_ENDED(held) false
#else
#define IS_ENDED(held) ended(held, 0.0)
#endif

// What a ray holds once it has entered.
vec4 begin_in_mesh() {
#ifdef VALUES
    return vec4(no_sample().rgb, 1.0);
#else
    return vec4(0.0);
#endif
}

// Goes on through cells from a face of the boundary, where there is one, to the next, with what the ray holds.
vec4 through_cells(CellRay ray, vec4 entered, vec4 held) {
    Entrance entrance = entrance_by(ray.line, uint(max(entered.y, 1.0)) - 1u);
    Way way = entrance.way;
    way.at = entered.zw;
    way.side = entered.y > 0.0 && !any(entrance.lefts) ? way.side : NOTHING;
    bool enters = true;
    // No ray goes through more cells than there are.
    for (int left_over = COUNT_OF_ROWS(tet_across); left_over > 0 && way.side != NOTHING && !IS_ENDED(held);) {
        Way next = leave(ray.line, way);
        held = joined(held, cell_light(ray, way, next, enters));
        way = next;
        enters = false;
        // Asked at the end as well: segment.glsl.
        --left_over;
        if (left_over <= 0 || way.side == NOTHING || IS_ENDED(held)) {
            break;
        }
    }
    return held;
}
