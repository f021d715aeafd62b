// Intermediate pass of `rc-ert`: stopping criterion [KW03 §2.1 "Intermediate passes", Thesis §5.2.2].
// IF(RES[x][y] > T) THEN z = MAX ELSE z = 0. Runs for every fragment, since it writes depth.
//
// BESIDE: a colour is attached and written for nothing (tet_update.frag has the reason): main passes of adaptive steps have two attachments,
// of which one blends.
//
// Departure: that a ray has left the volume is known from its length, not from an opacity of 1 in RES.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [PARTIAL_APART], [ENDLESS], [SURFACE], [SLICES], [PLANES], [ORTHOGRAPHIC], [ADAPTIVE], [BESIDE]

#include "shared/frame.glsl"
#include "shared/mark.glsl"
#include "shared/double_float.glsl"
#ifdef SLICES
#include "shared/ray.glsl"
#endif
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/opacity.glsl"
#ifndef ENDLESS
#define READS_GATHERED
#endif
#include "shared/projection.glsl"

#ifdef ADAPTIVE
// How far the ray has come, in steps of the shortest length.
layout(set = 0, binding = 72) uniform sampler2D reached;
#endif

#ifdef BESIDE
layout(location = 0) out float beside;
#endif

void main() {
#ifdef BESIDE
    beside = 0.0;
#endif
    Ray ray = load_ray();
#ifdef ADAPTIVE
    bool gone = texelFetch(reached, ivec2(gl_FragCoord.xy), 0).r >= ray.steps;
#else
    bool gone = this_step.pass * SAMPLES_PER_PASS >= ray.samples;
#endif
#ifdef ENDLESS
    bool saturated = false;
#else
    bool saturated = ended(texelFetch(GATHERED, ivec2(gl_FragCoord.xy), 0), 0.0);
#endif
#ifdef PARTIAL_APART
    if (!saturated && only_partial(ray, this_step.pass)) {
        MARK(PARTIAL_DEPTH);
        return;
    }
#endif
    MARK(gone || saturated ? DEAD : begins_later(ray, this_step.pass) ? SKIPPED : 0.0);
}
