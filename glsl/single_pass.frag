// Single-pass ray casting [Stegmaier05 §3, §5, Appendix]: entry, direction and the whole loop in one draw of the box's front faces.
//
// GOES_ON: the ray goes on behind a layer of polygons with what RES holds.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [LEAP_BLOCKS | LEAP_DISTANCES], [ENDLESS], [GOES_ON], [HOLES | PREINTEGRATED | ADAPTIVE], [FEW_PIECES], [PLANES | SINGLE_RAYS], [ORTHOGRAPHIC]
//@takes [VALUES], [SURFACE], [TRANSPARENT], [IN_VOLUME], [SHOWS_POSITION | SHOWS_NORMAL], [LIT], [SHADOWS], [TRANSLUCENT], [GRADIENTS], [ENVIRONMENT]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [CLIP_VOLUME]
//@takes [EFFECT], [REFRACTION], [BACKDROP], [BACKDROP_PICTURE]

#include "shared/single_pass.glsl"

#ifdef GOES_ON
layout(input_attachment_index = 0, set = 0, binding = 7) uniform subpassInput accumulated;
#endif

layout(location = 0) out vec4 gathered;

void main() {
    Ray ray = load_ray();
#ifdef GOES_ON
    vec4 held = subpassLoad(accumulated);
#else
    vec4 held = begin_ray(ray);
#endif
    gathered = cast_ray(ray, held);
}

#ifdef EFFECT
// The user's file, behind all else: what it defines has no meaning in the program's own text.
#include "effect.glsl"
#endif
