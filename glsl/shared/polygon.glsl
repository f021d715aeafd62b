// Polygons, and where the ray of a fragment meets them. Twin: src/scene/mesh/crossings.rs. Needs frame.glsl, double_float.glsl and
// ray.glsl.

struct Triangle {
    // Unit normal, and distance of the plane from where the view's rays come from: high and low parts.
    vec4 plane[2];
    uint material;
};
layout(set = 0, binding = 16, std430) readonly buffer Triangles {
    Triangle list[];
} triangles;

struct Material {
    // Linear colour and opacity, of fronts and of backs.
    vec4 colors[2];
    uint two_sided;
    // One more than the number of the clip mesh; 0 where it is none.
    uint clip;
};
layout(set = 0, binding = 17, std430) readonly buffer Materials {
    Material list[];
} materials;

// A ray and a triangle's plane.
struct Meeting {
    Material material;
    // Depth in front of the eye, as a double-float, and the length of the ray's direction, by which lengths are longer.
    vec2 depth;
    float stretch;
    // The cosine of the angle between ray and normal, times `stretch`: below 0 where the front is seen.
    float slope;
    bool front;
    // Whether the ray meets it beyond the near plane, on a side that shows.
    bool shown;
};

Meeting meet(uint triangle, vec2 pixel) {
    Triangle here = triangles.list[triangle];
    vec2 slope = vec2(0.0);
    vec2 square = vec2(0.0);
    vec2 away = vec2(here.plane[0].w, here.plane[1].w);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 direction = ray_direction(pixel, axis);
        vec2 normal = vec2(here.plane[0][axis], here.plane[1][axis]);
        slope = df_add(slope, df_multiply(direction, normal));
#ifdef ORTHOGRAPHIC
        away = df_add(away, -df_multiply(ray_shift(pixel, axis), normal));
#endif
        square = df_add(square, df_multiply(direction, direction));
    }
    Meeting found;
    found.material = materials.list[here.material];
    found.depth = df_divide(away, slope);
    found.stretch = df_sqrt(square).x;
    found.slope = slope.x;
    found.front = slope.x < 0.0;
    found.shown = slope.x != 0.0 && found.depth.x >= frame.near && (found.front || found.material.two_sided != 0u);
    return found;
}
