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
#if defined(TABLE)
#include "shared/cell_table.glsl"
#elif !defined(VALUES)
#include "shared/transfer.glsl"
#include "shared/cell_integral.glsl"
#endif
#include "shared/projection.glsl"

// What a way brings to a ray on which x goes evenly from `from.y` to `to.y`, at depths `from.x` and `to.x`.
vec4 cell_light(Line line, vec2 from, vec2 to) {
    float near = frame.near - tet_view.middle.x;
    if (from.x < near) {
        float part = to.x > from.x ? clamp((near - from.x) / (to.x - from.x), 0.0, 1.0) : 1.0;
        from = mix(from, to, part);
    }
    float lengths = max(to.x - from.x, 0.0) * line.stretch * tet_view.lengths;
#ifdef VALUES
    switch (PROJECTION) {
    case MIP:
        return to.x < near ? no_sample() : vec4(vec3(min(max(from.y, to.y), x_of(frame.end))), 1.0);
    case MINIP:
        return to.x < near ? no_sample() : vec4(vec3(max(min(from.y, to.y), x_of(frame.end))), 1.0);
    default:
        return vec4(vec3(0.5 * (from.y + to.y) * lengths), 0.0);
    }
#else
    return cell_integral(from.y, to.y, lengths);
#endif
}
