// Intermediate pass of `rc-block`: stopping criterion and empty-space skipping [KW03 §2.3, Thesis §5.2.4].
// IF(RES[x][y] > T) OR (EmptySpace == TRUE) THEN z = MAX ELSE z = 0. Runs for every fragment.
//
// Departures: 1. KW03 looks into the coarse volume every 8 steps and may miss a block between; here the block
// of every sample of the segment is asked. 2. Blocks hold the range of 9^3 voxels, since interpolation reaches
// the neighbour. 3. An empty segment is marked apart from a dead ray, so that the frame knows when all are dead.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY, [ENDLESS], [SURFACE]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [PARTIAL_APART], [SLICES], [PLANES], [ORTHOGRAPHIC]

#include "shared/frame.glsl"
#include "shared/mark.glsl"
#include "shared/double_float.glsl"
#ifdef SLICES
#include "shared/ray.glsl"
#endif
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/block.glsl"
#include "shared/visible_block.glsl"
#include "shared/opacity.glsl"
#ifndef ENDLESS
#define READS_GATHERED
#endif
#include "shared/projection.glsl"

bool segment_visible(Ray ray, uint first, uint end) {
    bool visible = false;
    // Asked at the end as well: segment.glsl.
    for (uint i = first; !visible && i < end;) {
        Place place = place_of(ray, i);
        ivec3 block = cell_of(place) / BLOCK;
        visible = block_visible(block);
        // Those that follow lie in the same block.
        i += samples_in_block(ray, place, block);
        if (SPANS && i < end) {
            visible = visible || way_visible(ray, i);
        }
        ++i;
        if (visible || i >= end) {
            break;
        }
    }
    return visible;
}

void main() {
    Ray ray = load_ray();
    uint first = segment_begin(ray, this_step.pass);
    uint end = min(this_step.pass * SAMPLES_PER_PASS + SAMPLES_PER_PASS, ray.samples);
#ifdef ENDLESS
    bool saturated = false;
#else
    bool saturated = ended(texelFetch(GATHERED, ivec2(gl_FragCoord.xy), 0), 0.0);
#endif
#ifdef PARTIAL_APART
    if (!saturated && only_partial(ray, this_step.pass)) {
        bool shows = segment_visible(ray, segment_begin(ray, (ray.samples - 1u) / SAMPLES_PER_PASS), ray.samples);
        MARK(shows ? PARTIAL_DEPTH : DEAD);
        return;
    }
#endif
    if (begins_later(ray, this_step.pass) && !saturated) {
        MARK(SKIPPED);
    } else if (first >= end || saturated) {
        MARK(DEAD);
    } else {
        MARK(segment_visible(ray, first, end) ? 0.0 : SKIPPED);
    }
}
