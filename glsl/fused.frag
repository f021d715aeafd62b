// Main pass k of the fused forms of near-neighbor skipping [Thesis §5.7: "combining the intermediate and main shader
// passes into one, except for the first pass"], for rays whose stored section begins at or before k: takes the segment's
// samples and marks where the ray goes on.
//
// 1. A ray that had ended before this pass is dead: it takes no sample, so that the picture is the one of
//    the passes apart, which test there too.
// 2. A ray that jumped here may have landed in free space: it goes on without a sample.
// 3. The others take M samples, and go on by what the intermediate pass k + 1 would decide at the next segment.
//
// RES is read and blended into at once: a fragment reads its own pixel, before its own blending, and front faces of a
// convex box cover no pixel twice. What takes no sample blends what changes nothing.
//
// Departure: a ray is marked dead in the pass in which it ends (its opacity rises above T), where that is certain before
// the blend unit has rounded it; the others are found at 1. in the pass that follows.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY | MARK_NONE, [CULL_DISCARD], [HOLES | PREINTEGRATED], [FEW_PIECES]
//@takes [DENSE], [ENDLESS], [VALUES], [SURFACE], [LIT], [GRADIENTS]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [PARTIAL_APART]

// RES comes first.
#define MARK_LOCATION 1

#include "shared/frame.glsl"
#include "shared/cull.glsl"
#include "shared/mark.glsl"
#include "shared/double_float.glsl"
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/section.glsl"
#ifndef DENSE
#include "shared/free.glsl"
#include "shared/distance.glsl"
#endif
#include "shared/near_neighbor.glsl"
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
#include "shared/shade.glsl"
#include "shared/segment.glsl"

#ifndef ENDLESS
#ifdef SURFACE
layout(input_attachment_index = 0, set = 0, binding = 7) uniform subpassInput surface_hit;
#define GATHERED surface_hit
#else
layout(input_attachment_index = 0, set = 0, binding = 7) uniform subpassInput accumulated;
#define GATHERED accumulated
#endif

// More than the blend unit may take from an opacity (BLEND_ROUNDING in src/twin/fused.rs).
layout(constant_id = 10) const float BLEND_ROUNDING = 0.0;
#endif

layout(location = 0) out vec4 contribution;

// Whether a ray goes on before this pass, and has ended with a segment added; of no matter where no ray of the view ends.
#ifdef ENDLESS
#define alive_before() true
#define saturated_by(segment) false
#ifdef PARTIAL_APART
#define alive_by(segment) true
#endif
#else
bool alive_before() {
    return !ended(subpassLoad(GATHERED), 0.0);
}

#ifdef PARTIAL_APART
// Whether a ray goes on with a segment added, whatever the blend unit rounds.
bool alive_by(vec4 segment) {
    return !ended(joined(subpassLoad(GATHERED), segment), -BLEND_ROUNDING);
}
#endif

bool saturated_by(vec4 segment) {
    return ended(joined(subpassLoad(GATHERED), segment), BLEND_ROUNDING);
}
#endif

void main() {
    float depth = DEAD;
    vec4 segment = no_sample();
    bool runs = may_run();
    if (runs) {
        if (alive_before()) {
            Ray ray = load_ray();
            uint next = next_section(ray, this_step.pass);
#ifdef PARTIAL_APART
            bool goes_on = true;
#endif
            if (next == this_step.pass) {
                segment = segment_color(ray, this_step.pass);
#ifdef PARTIAL_APART
                goes_on = alive_by(segment);
#endif
                next = saturated_by(segment) ? frame.passes : next_section(ray, this_step.pass + 1u);
            }
            // Always ahead, so that depths rise.
            depth = decision_depth(next, false);
#ifdef PARTIAL_APART
            // One that may have ended is looked at in its next main pass.
            if (goes_on && next < frame.passes && only_partial(ray, next)) {
                depth = PARTIAL_DEPTH;
            }
#endif
        }
    }
    DROP_UNLESS(runs);
    MARK(depth);
    contribution = segment;
}
