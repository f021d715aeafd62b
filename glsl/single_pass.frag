// Single-pass ray casting [Stegmaier05 §3, §5, Appendix]: entry, direction and the whole loop in one draw of the box's front faces.
//
// GOES_ON: the ray goes on behind a layer of polygons with what RES holds.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [LEAP_BLOCKS | LEAP_DISTANCES], [ENDLESS], [GOES_ON], [HOLES | PREINTEGRATED], [PLANES]
//@takes [VALUES], [SURFACE], [SHOWS_POSITION | SHOWS_NORMAL], [LIT], [GRADIENTS], [ENVIRONMENT]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED]

#define OWN_RAYS

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/opacity.glsl"
#include "shared/projection.glsl"
#ifdef PREINTEGRATED
#include "shared/preintegrated.glsl"
#elif !defined(VALUES)
#include "shared/transfer.glsl"
#endif
#if defined(LIT) || defined(SURFACE) && !defined(SHOWS_POSITION)
#include "shared/gradient.glsl"
#endif
#if defined(LIT) || defined(SURFACE) && !defined(SHOWS_POSITION) && !defined(SHOWS_NORMAL)
#include "shared/phong.glsl"
#endif
#ifdef ENVIRONMENT
#include "shared/environment.glsl"
#endif
#ifdef SURFACE
#include "shared/surface.glsl"
#include "shared/root.glsl"
#include "shared/surface_color.glsl"
#endif
#ifdef LEAP_DISTANCES
#include "shared/free.glsl"
#include "shared/distance.glsl"
#elif defined(LEAP_BLOCKS)
#include "shared/block.glsl"
#include "shared/visible_block.glsl"
#endif
#include "shared/leap.glsl"
#include "shared/shade.glsl"
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
