// The colour of a layer, blended under all that is in front of it [Thesis ch. 6 §2.2: "blended in by a separate fragment
// program after each rendering of the volume"].
#version 460
#extension GL_GOOGLE_include_directive : require

layout(set = 0, binding = 15) uniform sampler2D layer;
layout(set = 0, binding = 16) uniform sampler2D layer_color;

layout(location = 0) out vec4 accumulated;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (texelFetch(layer, pixel, 0).x == 0.0) {
        discard;
    }
    accumulated = texelFetch(layer_color, pixel, 0);
}
