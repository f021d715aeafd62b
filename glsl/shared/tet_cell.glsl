// What a cell does to a ray that goes through it. Twin: src/twin/tetrahedra.rs.

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/pixel.glsl"
#include "shared/seen.glsl"
#include "shared/way.glsl"
#include "shared/cells.glsl"
#include "shared/opacity.glsl"
#include "shared/logarithm.glsl"
#if defined(SURFACE) && !defined(IN_VOLUME)
// Nothing but surfaces shows.
#elif defined(TABLE)
#include "shared/cell_table.glsl"
#elif !defined(VALUES)
#include "shared/transfer.glsl"
#include "shared/cell_integral.glsl"
#endif
#include "shared/projection.glsl"
#ifdef SURFACE
#include "shared/surface.glsl"
#include "shared/phong.glsl"
#include "shared/cell_surface.glsl"
#endif

// What the cell between two faces brings to a ray, on which x goes evenly from the one to the other. `enters`: the ray comes from outside
// of the mesh.
vec4 cell_light(Line line, Way way, Way next, bool enters) {
    vec2 from = way.at;
    vec2 to = next.at;
    float near = frame.near - tet_view.middle.x;
    // Where the ray begins to be drawn.
    bool begins = from.x <= near ? to.x > near : enters;
    if (from.x < near) {
        float part = to.x > from.x ? clamp((near - from.x) / (to.x - from.x), 0.0, 1.0) : 1.0;
        from = mix(from, to, part);
    }
#if defined(SURFACE)
    // The corner that the next face has and this one has not is its first.
    uvec4 corners = uvec4(way.a.number, way.b.number, way.c.number, next.a.number);
    return through_surfaces(line, corners, begins, from, to);
#elif defined(VALUES)
    float lengths = max(to.x - from.x, 0.0) * line.stretch * tet_view.lengths;
    switch (PROJECTION) {
    case MIP:
        return to.x < near ? no_sample() : vec4(vec3(min(max(from.y, to.y), x_of(frame.end))), 1.0);
    case MINIP:
        return to.x < near ? no_sample() : vec4(vec3(max(min(from.y, to.y), x_of(frame.end))), 1.0);
    default:
        return vec4(vec3(0.5 * (from.y + to.y) * lengths), 0.0);
    }
#else
    return cell_integral(from.y, to.y, max(to.x - from.x, 0.0) * line.stretch * tet_view.lengths);
#endif
}
