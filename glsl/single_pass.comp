// Single-pass ray casting [Stegmaier05 §3, §5] as a compute shader: a ray an invocation, in tiles of 8 x 8 pixels.
//
// GOES_ON: the ray goes on behind a layer of polygons with what RES holds. RGBA32F, RGBA16F, RGBA8: the format of RES.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes RGBA32F | RGBA16F | RGBA8
//@takes [LEAP_BLOCKS | LEAP_DISTANCES], [ENDLESS], [GOES_ON], [HOLES | PREINTEGRATED | ADAPTIVE], [FEW_PIECES], [PLANES | SINGLE_RAYS], [ORTHOGRAPHIC]
//@takes [VALUES], [SURFACE], [TRANSPARENT], [IN_VOLUME], [SHOWS_POSITION | SHOWS_NORMAL], [LIT], [SHADOWS], [TRANSLUCENT], [GRADIENTS], [ENVIRONMENT]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [CLIP_VOLUME]
//@takes [EFFECT], [REFRACTION], [BACKDROP], [BACKDROP_PICTURE]

#define COMPUTE
#include "shared/single_pass.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if defined(RGBA32F)
layout(set = 0, binding = 7, rgba32f) uniform image2D accumulated;
#elif defined(RGBA16F)
layout(set = 0, binding = 7, rgba16f) uniform image2D accumulated;
#else
layout(set = 0, binding = 7, rgba8) uniform image2D accumulated;
#endif

void main() {
    ivec2 pixel = this_pixel();
    if (any(greaterThanEqual(pixel, imageSize(accumulated)))) {
        return;
    }
    Ray ray = load_ray();
#ifdef GOES_ON
    vec4 held = imageLoad(accumulated, pixel);
#else
    // Nothing is drawn where the ray misses the volume, whose box draws no pixel there.
    vec4 held = ray.steps > 0.0 ? begin_ray(ray) : vec4(0.0);
#endif
    imageStore(accumulated, pixel, cast_ray(ray, held));
}

#ifdef EFFECT
// The user's file, behind all else: what it defines has no meaning in the program's own text.
#include "effect.glsl"
#endif
