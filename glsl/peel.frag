// Depth peeling [Thesis ch. 6 §1.5]: of the polygons that a ray meets behind the layer before, and in front of opaque ones,
// the nearest: where it is and its lit colour.
//
// Departures: 1. Depth is near over depth, computed from the triangle's plane, and greater where nearer. 2. Of surfaces at one
// depth the one with the least number is nearest: fragments arrive in the order of their triangles, and the depth test keeps the
// first of equals; so coplanar faces are layers one after the other, and none is lost or comes twice. 3. Opaque polygons are
// peeled once and no further.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [LAYER_BEFORE], [OPAQUE]

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/layer.glsl"

struct Triangle {
    // Unit normal, and distance of the plane from the eye: high and low parts.
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
};
layout(set = 0, binding = 17, std430) readonly buffer Materials {
    Material list[];
} materials;

layout(location = 0) flat in uint triangle;

layout(location = 0) out vec4 surface;
layout(location = 1) out vec4 color;

// A light at the eye: the part of a colour that shows where it is seen from the side.
const float AMBIENT = 0.3;

void main() {
    vec2 pixel = gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
    Triangle here = triangles.list[triangle];
    vec2 slope = vec2(0.0);
    vec2 square = vec2(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 direction = ray_direction(pixel, axis);
        slope = df_add(slope, df_multiply(direction, vec2(here.plane[0][axis], here.plane[1][axis])));
        square = df_add(square, df_multiply(direction, direction));
    }
    float length = df_sqrt(square).x;
    vec2 depth = df_divide(vec2(here.plane[0].w, here.plane[1].w), slope);
    bool front = slope.x < 0.0;
    Material material = materials.list[here.material];

    float key = frame.near / depth.x;
    float number = float(triangle) + 1.0;
    bool shown = slope.x != 0.0 && depth.x >= frame.near && (front || material.two_sided != 0u);
#ifdef LAYER_BEFORE
    vec4 before = layer_before();
    shown = shown && (key < before.x || (key == before.x && number > before.y));
#endif
#ifdef OPAQUE
    vec4 behind = layer_behind();
    shown = shown && key > behind.x;
#endif
    if (!shown) {
        discard;
    }
    vec2 way = df_add(depth, -box_interval(pixel).enter);
    surface = vec4(key, number, way.x * length, 0.0);
    vec4 look = material.colors[front ? 0 : 1];
    float light = AMBIENT + (1.0 - AMBIENT) * abs(slope.x) / length;
    color = vec4(look.rgb * (light * look.a), look.a);
    gl_FragDepth = key;
}
