// Intermediate pass of `rc-block`: stopping criterion and empty-space skipping [KW03 §2.3, Thesis §5.2.4].
// IF(RES[x][y] > T) OR (EmptySpace == TRUE) THEN z = MAX ELSE z = 0. Runs for every fragment.
//
// Departures: 1. KW03 looks into the coarse volume every 8 steps and may miss a block between; here the block
// of every sample of the segment is asked. 2. Blocks hold the range of 9^3 voxels, since interpolation reaches
// the neighbour. 3. An empty segment is marked apart from a dead ray, so that the frame knows when all are dead.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY, [ENDLESS], [SURFACE]
//@takes [LAYER_BEFORE], [LAYER_BEHIND], [OPAQUE], [CLIPPED], [PARTIAL_APART]

#include "shared/frame.glsl"
#include "shared/mark.glsl"
#include "shared/double_float.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/block.glsl"
#include "shared/opacity.glsl"
#ifndef ENDLESS
#define READS_GATHERED
#endif
#include "shared/projection.glsl"

layout(set = 0, binding = 8, std430) readonly buffer CellRange {
    vec2 ranges[];
} cell_range;
// CT [KW03 §2.3]: whether anything shows between a minimum and a maximum.
layout(set = 0, binding = 9) uniform usampler2D block_table;

// A sample stands for all values up to the next one (shared/preintegrated.glsl).
layout(constant_id = 12) const bool SPANS = false;

// A sample this near (in steps) beyond the face of a block is asked for by itself: f32 cannot tell its side.
const float BOUNDARY = 1e-3;

bool block_visible(ivec3 block) {
    ivec3 blocks = block_count(ivec3(frame.dims.xyz));
    vec2 range = cell_range.ranges[(block.z * blocks.y + block.y) * blocks.x + block.x];
    return texelFetch(block_table, range_codes(range), 0).r != 0u;
}

// Whether anything shows in the blocks from that of sample `i` to that of the next sample, or of the exit point, with
// those beside the way, whose corners a ray may cut off.
bool way_visible(Ray ray, uint i) {
    ivec3 front = cell_of(place_at(ray, steps_to(i))) / BLOCK;
    ivec3 back = cell_of(place_at(ray, min(steps_to(i + 1u), ray.steps))) / BLOCK;
    ivec3 low = min(front, back);
    ivec3 high = max(front, back);
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                if (block_visible(ivec3(x, y, z))) {
                    return true;
                }
            }
        }
    }
    return false;
}

bool segment_visible(Ray ray, uint first, uint end) {
    for (uint i = first; i < end;) {
        Place place = place_at(ray, steps_to(i));
        ivec3 block = cell_of(place) / BLOCK;
        if (block_visible(block)) {
            return true;
        }
        // Those that follow lie in the same block.
        i += uint(max(floor(steps_inside(ray, place, block, BLOCK) - BOUNDARY), 0.0));
        if (SPANS && i < end && way_visible(ray, i)) {
            return true;
        }
        ++i;
    }
    return false;
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
