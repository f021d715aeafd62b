// Slices of the volume: a sample on each, blended with what the pixel has [Thesis §3.4, KW03 §1.1].
//
// Departures: 1. Where a fragment lies is computed from its pixel, not interpolated from corners, which rasterisers move to a raster of
// 1/256 pixel; polygons are wider than the volume, and what is outside is dropped here. 2. Opacities are those of the way from slice to
// slice along the ray of each pixel, which is longer towards the sides of a picture in perspective and across the axes of the volume.
//
// STACK: values are those of a stack of 2D textures across an axis of the volume [Thesis §3.4.1].
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [CULL_DISCARD], [HOLES | PREINTEGRATED], [FEW_PIECES], [PLANES], [ORTHOGRAPHIC], [STACK]
//@takes [VALUES], [LIT], [GRADIENTS]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED]

#define SLICES

#include "shared/frame.glsl"
#include "shared/cull.glsl"
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
#ifdef LIT
#include "shared/gradient.glsl"
#include "shared/phong.glsl"
#endif
#include "shared/shade.glsl"

layout(location = 0) flat in float slice;

layout(location = 0) out vec4 accumulated;

void main() {
    vec4 color = no_sample();
    bool shows = may_run();
    if (shows) {
        vec2 pixel = gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
        Ray ray = ray_on_slice(pixel, slice, FILTER != HARDWARE);
        shows = is_inside(ray) && is_between_layers(ray);
        if (shows) {
            if (PROJECTION == AVERAGE) {
                ray.samples = slices_met(pixel);
            }
#ifdef PREINTEGRATED
            float front = node_at(ray, 0u);
            color = shade_span(ray, 0u, front);
#else
            color = shade_sample(ray, 0u);
#endif
        }
    }
    if (!shows) {
        discard;
    }
    accumulated = color;
}
