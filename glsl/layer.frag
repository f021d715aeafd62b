// The colour of a layer, blended under all that is in front of it [Thesis ch. 6 §2.2: "blended in by a separate fragment
// program after each rendering of the volume"]. SURFACE: not where the ray has met an iso-surface in front of it.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [SURFACE]

layout(set = 0, binding = 15) uniform sampler2D layer;
layout(set = 0, binding = 16) uniform sampler2D layer_color;

#ifdef SURFACE
layout(set = 0, binding = 7) uniform sampler2D surface_hit;
#endif

layout(location = 0) out vec4 accumulated;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (texelFetch(layer, pixel, 0).x == 0.0) {
        discard;
    }
#ifdef SURFACE
    if (texelFetch(surface_hit, pixel, 0).a > 0.0) {
        discard;
    }
#endif
    accumulated = texelFetch(layer_color, pixel, 0);
}
