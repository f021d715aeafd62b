// A propagation step [Weiler03 "Multi-Pass Algorithm"]: exit point of the current cell, scalar there, ray integral within the cell, blending,
// and the adjacent cell. Traversal data are read from one set and written to the other.
//
// Departures: 1. Which face a ray leaves by follows from the sides on which it passes edges, exactly, and not from the least parameter among
// the planes of faces whose backs are seen: rounding loses no ray at edges and vertices. 2. The scalar is that of the three corners of the
// face, by the areas that are known then, and not g . x and an offset, whose g has no digits in flat cells. 3. Colours are blended by the
// blend unit, so that they need no copy in passes that find no cell.
#version 460
#extension GL_GOOGLE_include_directive : require
//
// ENTERS: the first pass behind a layer, to which rays come from outside of the mesh. SURFACE: iso-surfaces show; IN_VOLUME: within colours.
//@takes [CULL_DISCARD], [VALUES | TABLE], [FEW_PIECES], [SURFACE], [IN_VOLUME], [ENTERS], [FROM_WITHIN], [STORAGE]
// llvmpipe runs it faster as it is: 85 ms where optimised it takes 92 (Mesa 26.1, the cube of 24,576 cells).
//@unoptimised

#include "shared/tet_cell.glsl"
#include "shared/cull.glsl"
#ifndef CULL_DISCARD
layout(early_fragment_tests) in;
#endif

layout(set = 0, binding = 67) uniform sampler2D tet_cell;
layout(set = 0, binding = 68) uniform sampler2D tet_point;

layout(location = 0) out vec2 next_cell;
layout(location = 1) out vec2 next_point;
layout(location = 2) out vec4 gathered;

// Corners of each cell, by rising numbers.
ROWS(70, TetCells, usamplerBuffer, uvec4, tet_cells);

// A ray that enters a cell by the face opposite to a corner, as traversal data have it.
Way way_into(Line line, uint cell, uint place, vec2 at) {
    uvec4 corners = ROW(tet_cells, cell);
    uvec3 face = place == 0u ? corners.yzw : place == 1u ? corners.xzw : place == 2u ? corners.xyw : corners.xyz;
    Way way;
    way.side = 4u * cell + place + 1u;
    way.apex = corners[place];
    way.a = seen(line, face.x);
    way.b = seen(line, face.y);
    way.c = seen(line, face.z);
    Turn first = turn(way.a, way.b);
    if (first.left) {
        Seen other = way.b;
        way.b = way.c;
        way.c = other;
        first = turn(way.a, way.b);
    }
    way.areas = vec3(turn(way.b, way.c).area, turn(way.c, way.a).area, first.area);
    way.at = at;
    return way;
}

void main() {
    bool runs = may_run();
    next_cell = vec2(0.0);
    next_point = vec2(0.0);
    gathered = no_sample();
    if (runs) {
        ivec2 texel = ivec2(gl_FragCoord.xy);
        vec2 here = texelFetch(tet_cell, texel, 0).xy;
        if (here.x > 0.0) {
            CellRay ray = cell_ray(gl_FragCoord.xy);
            Way way = way_into(ray.line, uint(here.x) - 1u, uint(here.y), texelFetch(tet_point, texel, 0).xy);
            Way next = leave(ray.line, way);
#ifdef ENTERS
            gathered = cell_light(ray, way, next, true);
#else
            gathered = cell_light(ray, way, next, false);
#endif
            next_point = next.at;
            if (next.side != NOTHING) {
                next_cell = vec2(float((next.side - 1u) >> 2) + 1.0, float((next.side - 1u) & 3u));
            }
        }
    }
    DROP_UNLESS(runs);
}
