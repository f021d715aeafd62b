// Main pass: ray traversal [KW03 §2.1, Thesis §5.2.2]. M samples of the ray's segment for this pass, joined
// front to back; the blend unit joins the segment with what the pixel has already.
//
// SURFACE: it looks for the nearest place on an iso-surface, and writes where that is with opacity 1, which ends the ray; what it
// looks like is found in one pass for all rays (lighting.frag) [Thesis ch. 5 §3.2].
//
// ADAPTIVE: M steps of lengths of their own, from where the ray has come to in the passes before (GOES_ON) (Weiler03 "Adaptive Sampling").
//
// PARTIAL: behind all other main passes, the segments that end at a surface, of rays that were left for it [Thesis ch. 6 §7].
//
// Departure: a ray that has left the volume takes no samples, and the intermediate pass knows its length; KW03
// writes opacity 1 to RES for it, which would change the picture.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [CULL_DISCARD], [HOLES | PREINTEGRATED], [FEW_PIECES]
//@takes [VALUES], [SURFACE], [LIT], [GRADIENTS]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [PARTIAL], [ADAPTIVE], [GOES_ON]

#include "shared/frame.glsl"
#include "shared/cull.glsl"
#include "shared/double_float.glsl"
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
#ifdef SURFACE
#include "shared/surface.glsl"
#endif
#ifdef LIT
#include "shared/gradient.glsl"
#include "shared/phong.glsl"
#endif
#ifdef ADAPTIVE
#include "shared/logarithm.glsl"
#include "shared/cell_integral.glsl"
#include "shared/adaptive.glsl"
#else
#include "shared/shade.glsl"
#include "shared/segment.glsl"
#endif

#ifndef CULL_DISCARD
layout(early_fragment_tests) in;
#endif

layout(location = 0) out vec4 accumulated;
#ifdef ADAPTIVE
// How far the ray has come, in steps of the shortest length.
layout(location = 1) out float reached_now;
#ifdef GOES_ON
layout(input_attachment_index = 0, set = 0, binding = 72) uniform subpassInput reached;
#endif

// M steps, front to back, from so many of the shortest ones on.
vec4 segment_color(Ray ray, inout uint at) {
    vec4 segment = vec4(0.0);
    AdaptiveWay way = begin_way(ray, at);
    uint left_over = SAMPLES_PER_PASS;
    // Nothing passes through what is opaque, whatever is left of its step.
    while (segment.a < 1.0 && in_step(way) || left_over > 0u && !in_step(way) && float(way.at) < ray.steps) {
        left_over -= in_step(way) ? 0u : 1u;
        segment = composite(segment, adaptive_part(ray, way));
        // Asked at the end as well: segment.glsl.
        if (in_step(way) ? segment.a >= 1.0 : left_over == 0u || float(way.at) >= ray.steps) {
            break;
        }
    }
    at = way.at;
    return segment;
}
#endif

void main() {
    vec4 segment = no_sample();
    bool runs = may_run();
#ifdef ADAPTIVE
#ifdef GOES_ON
    uint at = uint(subpassLoad(reached).r);
#else
    uint at = 0u;
#endif
    if (runs) {
        segment = segment_color(load_ray(), at);
    }
    reached_now = float(at);
#else
    if (runs) {
        Ray ray = load_ray();
#ifdef PARTIAL
        uint pass = (max(ray.samples, 1u) - 1u) / SAMPLES_PER_PASS;
#else
        uint pass = this_step.pass;
#endif
        segment = segment_color(ray, pass);
    }
#endif
    DROP_UNLESS(runs);
    accumulated = segment;
}
