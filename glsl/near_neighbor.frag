// Intermediate pass of near-neighbor skipping [Thesis §5.3]: runs before main pass k, for rays whose stored
// section begins at or before it; reads the distance to the nearest interesting cell at the segment's first
// sample and marks the section in which that distance ends.
//
// Departures: those of shared/near_neighbor.glsl, and: 1. BEGINS: before the first pass behind a layer rays without that layer
// keep their marks, which are dead or those of the last pass, where they die; the thesis marks every ray anew there
// [Thesis ch. 6 §4], which is most of what a layer costs it. 2. FRAGDEPTH_ANY marks a section in which the ray arrives a little
// later in the section than one that lies ahead: depths only rise, so that compare GREATER lets every mark pass and
// counts it.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY, [CULL_DISCARD | BEGINS], [DENSE], [ENDLESS], [SURFACE]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [PARTIAL_APART], [SLICES], [PLANES], [ORTHOGRAPHIC]

#include "shared/frame.glsl"
#include "shared/cull.glsl"
#include "shared/mark.glsl"
#include "shared/double_float.glsl"
#ifdef SLICES
#include "shared/ray.glsl"
#endif
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/section.glsl"
#ifndef DENSE
#include "shared/free.glsl"
#include "shared/distance.glsl"
#endif
#include "shared/near_neighbor.glsl"
#include "shared/opacity.glsl"
#ifndef ENDLESS
#define READS_GATHERED
#endif
#include "shared/projection.glsl"

#ifdef PARTIAL_APART
// A segment that ends at a surface is left for its own pass as soon as it comes next, not only on arrival: main passes that mark
// would run for it, and take no sample.
layout(constant_id = 18) const bool PARTIAL_AHEAD = false;
#endif

float decide(Ray ray) {
#ifndef ENDLESS
    if (ended(texelFetch(GATHERED, ivec2(gl_FragCoord.xy), 0), 0.0)) {
        return DEAD;
    }
#endif
    uint next = next_section(ray, this_step.pass);
    bool arrived = next == this_step.pass;
#ifdef PARTIAL_APART
    if ((arrived || PARTIAL_AHEAD) && next < frame.passes && only_partial(ray, next)) {
        return PARTIAL_DEPTH;
    }
#endif
    return decision_depth(next, arrived);
}

void main() {
#ifdef BEGINS
    if (!goes_on(layer_before())) {
        discard;
    }
#endif
    float depth = DEAD;
    bool runs = may_run();
    if (runs) {
        depth = decide(load_ray());
    }
    DROP_UNLESS(runs);
    MARK(depth);
}
