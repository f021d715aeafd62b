// Depth peeling [Thesis ch. 6 §1.5]: of the polygons that a ray meets behind the layer before, and in front of opaque ones,
// the nearest: where it is and its lit colour.
//
// Departures: 1. Depth is near over depth, computed from the triangle's plane, and greater where nearer. 2. Of surfaces at one
// depth the one with the least number is nearest: fragments arrive in the order of their triangles, and the depth test keeps the
// first of equals; so coplanar faces are layers one after the other, and none is lost or comes twice. 3. Opaque polygons are
// peeled once and no further. 4. Clip geometry that keeps what is inside or outside is peeled with the others, without a colour
// (CLIPPED). 5. Clip geometry that hides what is in front of its first surface is drawn before the others, which begin behind it
// (CLIP_FIRST): the thesis draws it after them with the depth test reversed, so that it takes the place of what is in front of it,
// and a layer with it [Thesis ch. 6 §3]. The picture is the same, and so is what main passes read.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [LAYER_BEFORE], [OPAQUE], [COLORED], [CLIPPED], [CLIP_FIRST], [PLANES], [ORTHOGRAPHIC]

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/polygon.glsl"
#ifdef CLIPPED
#include "shared/clip.glsl"
#endif

layout(location = 0) flat in uint triangle;

layout(location = 0) out vec4 surface;
#ifdef COLORED
layout(location = 1) out vec4 color;
#endif

// A light at the eye: the part of a colour that shows where it is seen from the side.
const float AMBIENT = 0.3;

#ifdef LAYER_BEFORE
// The layer before. A ray that meets no clip geometry keeps its polygons and loses the volume.
vec4 before_all() {
    vec4 before = layer_before();
#ifdef CLIP_FIRST
    before = before.x == 0.0 ? vec4(1.0, 0.0, 0.0, -1.0) : vec4(before.xyz, 1.0);
#endif
    return before;
}
#endif

#ifdef CLIPPED
// Whether the volume is kept behind the surface, and within which clip meshes it is.
float state_behind(Meeting found) {
#ifdef LAYER_BEFORE
    float state = before_all().w;
#else
    float state = clip_state_at_begin(vec4(0.0));
#endif
    return found.material.clip == 0u ? state : clip_state_behind(state, found.material.clip - 1u, found.front);
}
#endif

void main() {
    vec2 pixel = gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
    Meeting found = meet(triangle, pixel);
    float key = frame.near / found.depth.x;
    float number = float(triangle) + 1.0;
    bool shown = found.shown;
#ifdef LAYER_BEFORE
    vec4 before = before_all();
    shown = shown && (key < before.x || (key == before.x && number > before.y));
#endif
#ifdef OPAQUE
    vec4 behind = layer_behind();
    shown = shown && key > behind.x;
#endif
    if (!shown) {
        discard;
    }
    vec2 way = df_add(found.depth, -box_interval(pixel, view_ray(pixel)).enter);
    surface = vec4(key, number, way.x * found.stretch, 0.0);
#ifdef CLIPPED
    surface.w = state_behind(found);
#endif
#ifdef COLORED
    vec4 look = found.material.colors[found.front ? 0 : 1];
    float light = AMBIENT + (1.0 - AMBIENT) * abs(found.slope) / found.stretch;
    color = vec4(look.rgb * (light * look.a), look.a);
#endif
    gl_FragDepth = key;
}
