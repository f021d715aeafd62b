// Iso-surfaces within cells: along a ray x is linear in each, so that it crosses a level once at the most, and the normal is along the
// cell's own gradient [Weiler03 "Isosurface Ray Casting"]. Twin: src/scene/tetrahedra/surface.rs. Needs cells.glsl, surface.glsl,
// phong.glsl and projection.glsl; with IN_VOLUME cell_integral.glsl or cell_table.glsl.

// Vertices in volume space, and their x.
ROWS(62, TetPoints, samplerBuffer, vec4, tet_points);

// A vector along the gradient of x in a cell of those corners, or against it: lights do not tell the two apart.
vec3 cell_gradient(uvec4 corners) {
    vec4 first = ROW(tet_points, corners.x);
    vec4 a = ROW(tet_points, corners.y) - first;
    vec4 b = ROW(tet_points, corners.z) - first;
    vec4 c = ROW(tet_points, corners.w) - first;
    return cross(b.xyz, c.xyz) * a.w + cross(c.xyz, a.xyz) * b.w + cross(a.xyz, b.xyz) * c.w;
}

// What shows of a surface in a cell of those corners at a depth from the middle of the mesh, premultiplied.
vec4 shown_surface(CellRay ray, int level, uvec4 corners, float depth) {
    vec4 unlit = surface_levels.list[level].color;
    vec3 point = fma(vec3(depth), ray.direction, ray.origin);
    vec3 color = lit(unlit.rgb, cell_gradient(corners), point, -normalize(ray.direction));
    return vec4(color * unlit.a, unlit.a);
}

// Within how many surfaces x is.
int levels_around(float x) {
    int within = 0;
    for (int i = surface_levels.list.length() - 1; i >= 0; --i) {
        within += int(x >= x_of(surface_levels.list[i].from));
    }
    return within;
}

#ifdef IN_VOLUME
// What the volume brings between two places of a ray, each a depth and x.
vec4 volume_between(CellRay ray, vec2 from, vec2 to) {
    return cell_integral(from.y, to.y, max(to.x - from.x, 0.0) * ray.lengths);
}
#endif

// What a cell of those corners brings to a ray between two places, each a depth and x: all surfaces that it crosses there, and where it
// begins the innermost that it begins within.
vec4 through_surfaces(CellRay ray, uvec4 corners, bool begins, vec2 from, vec2 to) {
    int within = levels_around(from.y);
    int rise = levels_around(to.y) - within;
    int crossed = abs(rise);
    vec4 light = vec4(0.0);
    vec2 at = from;
    // Asked at the end as well: segment.glsl.
    for (int left_over = crossed + int(begins && within > 0); left_over > 0;) {
        bool first = left_over > crossed;
        int passed = crossed - left_over;
        int level = first || rise < 0 ? within - 1 - max(passed, 0) : within + passed;
        float x = first ? from.y : x_of(surface_levels.list[level].from);
        float share = first ? 0.0 : clamp((x - from.y) / (to.y - from.y), 0.0, 1.0);
        vec2 place = vec2(mix(from.x, to.x, share), x);
#ifdef IN_VOLUME
        light = composite(light, volume_between(ray, at, place));
#endif
        light = composite(light, shown_surface(ray, level, corners, place.x));
        at = place;
        --left_over;
        if (left_over <= 0) {
            break;
        }
    }
#ifdef IN_VOLUME
    light = composite(light, volume_between(ray, at, to));
#endif
    return light;
}
