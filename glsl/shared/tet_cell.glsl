// What a cell does to a ray that goes through it. Twin: src/twin/tetrahedra.rs.
//
// FROM_WITHIN: rays may begin within the mesh, in the middle of a cell.

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/pixel.glsl"
#include "shared/seen.glsl"
#include "shared/way.glsl"
#include "shared/cells.glsl"
#include "shared/opacity.glsl"
#include "shared/logarithm.glsl"

// A ray on its way through cells.
struct CellRay {
    Line line;
    // What it comes on in a unit of depth, in reference lengths.
    float lengths;
#ifdef SURFACE
    // Where it is in the middle of the mesh, and what it comes on in a unit of depth: volume space.
    vec3 origin;
    vec3 direction;
#endif
};

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

// `pixel`: from the upper left corner of targets, centres at + 0.5.
CellRay cell_ray(vec2 pixel) {
    CellRay ray;
    ray.line = line_through(pixel);
    vec2 from_middle = pixel + tet_view.corner;
    ray.lengths = sqrt(tet_view.square.x + tet_view.square.y * from_middle.x * from_middle.x + tet_view.square.z * from_middle.y * from_middle.y);
#ifdef SURFACE
    vec2 place = pixel + vec2(frame.first_column, frame.first_row);
    vec3 shift = place.x * frame.right[0].xyz + place.y * frame.down[0].xyz;
    ray.direction = frame.base[0].xyz + tet_view.slope * shift;
    ray.origin = frame.origin[0].xyz + (1.0 - tet_view.slope) * shift + tet_view.depth * ray.direction;
#endif
    return ray;
}

#ifdef FROM_WITHIN
// Where rays begin: read once, before the loop over cells (transfer.glsl).
float tet_near = tet_view.near;
#endif

// What the cell between two faces brings to a ray, on which x goes evenly from the one to the other. `enters`: the ray comes from outside
// of the mesh.
vec4 cell_light(CellRay ray, Way way, Way next, bool enters) {
    vec2 from = way.at;
    vec2 to = next.at;
    bool begins = enters;
#ifdef FROM_WITHIN
    begins = from.x <= tet_near ? to.x > tet_near : enters;
    if (from.x < tet_near) {
        float part = to.x > from.x ? clamp((tet_near - from.x) / (to.x - from.x), 0.0, 1.0) : 1.0;
        from = mix(from, to, part);
    }
#ifdef VALUES
    if (to.x < tet_near) {
        return no_sample();
    }
#endif
#endif
#if defined(SURFACE)
    // The corner that the next face has and this one has not is its first.
    uvec4 corners = uvec4(way.a.number, way.b.number, way.c.number, next.a.number);
    return through_surfaces(ray, corners, begins, from, to);
#elif defined(VALUES)
    float lengths = max(to.x - from.x, 0.0) * ray.lengths;
    switch (PROJECTION) {
    case MIP:
        return vec4(vec3(min(max(from.y, to.y), x_of(frame.end))), 1.0);
    case MINIP:
        return vec4(vec3(max(min(from.y, to.y), x_of(frame.end))), 1.0);
    default:
        return vec4(vec3(0.5 * (from.y + to.y) * lengths), 0.0);
    }
#else
    return cell_integral(from.y, to.y, max(to.x - from.x, 0.0) * ray.lengths);
#endif
}
