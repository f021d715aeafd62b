// The lighting pass of iso-surfaces, once for all rays [Thesis ch. 5 §3.2]: of each ray that has met a surface, the exact place of it
// between the two samples that enclose it, its normal along the gradient there, and its colour in all lights, under what is in front
// of it. SHOWS_POSITION: in place of the colour the exact place; SHOWS_NORMAL: the normal, turned to the eye; both in volume space.
// ENVIRONMENT: the colour is mixed with that of what the surface reflects.
//
//@takes [SHOWS_POSITION | SHOWS_NORMAL], [GRADIENTS], [ENVIRONMENT]
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/opacity.glsl"
#include "shared/surface.glsl"
#include "shared/root.glsl"
#ifndef SHOWS_POSITION
#include "shared/gradient.glsl"
#endif
#if !defined(SHOWS_POSITION) && !defined(SHOWS_NORMAL)
#include "shared/phong.glsl"
#endif
#ifdef ENVIRONMENT
#include "shared/environment.glsl"
#endif
#include "shared/surface_color.glsl"

layout(set = 0, binding = 7) uniform sampler2D surface_hit;

layout(location = 0) out vec4 accumulated;

void main() {
    vec4 hit = texelFetch(surface_hit, ivec2(gl_FragCoord.xy), 0);
    if (hit.a == 0.0) {
        discard;
    }
    accumulated = surface_color(load_ray(), hit.xy);
}
