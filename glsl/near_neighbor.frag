// Intermediate pass of near-neighbor skipping [Thesis §5.3]: runs before main pass k, for rays whose stored
// section begins at or before it; reads the distance to the nearest interesting cell at the segment's first
// sample and marks the section in which that distance ends.
//
// Departures: 1. distances are bounds for the trilinear footprint, not from voxel to voxel. 2. EXIT_LOOKAHEAD:
// a ray that will have left the volume by then is dead at once. 3. FRAGDEPTH_ANY marks a section in which the
// ray arrives a little later in the section than one that lies ahead: depths only rise, so that compare GREATER
// lets every mark pass and counts it. 4. all samples within the distance are free, so the first that may show
// something is a step beyond the last of them.
#version 460
#extension GL_GOOGLE_include_directive : require
//@variant fragdepth MARK_FRAGDEPTH
//@variant fragdepth-any MARK_FRAGDEPTH_ANY
//@variant copy MARK_COPY
//@variant copy+discard MARK_COPY CULL_DISCARD

#include "shared/frame.glsl"
#include "shared/cull.glsl"
#include "shared/mark.glsl"
#include "shared/double_float.glsl"
#include "shared/samples.glsl"
#include "shared/section.glsl"

layout(set = 0, binding = 7) uniform sampler2D accumulated;
// Lower bound of the distance to the nearest interesting cell, in voxels of the finest spacing: a byte, or eight bytes
// in two words, one for each octant.
layout(set = 0, binding = 10) uniform usampler3D nearest_distance;

layout(constant_id = 6) const bool EXIT_LOOKAHEAD = true;
// Side of a cell of the structure, in voxels.
layout(constant_id = 7) const int CELL = 1;
// The structure tells octants apart.
layout(constant_id = 8) const bool OCTANTS = false;

// Voxels that are free from sample `i` on, along the ray.
float free_distance(Ray ray, uint i) {
    uvec2 texel = texelFetch(nearest_distance, cell_of(sample_place(ray, i)) / CELL, 0).rg;
    if (!OCTANTS) {
        return float(texel.x);
    }
    uvec3 down = uvec3(lessThan(ray.step_vector, vec3(0.0)));
    return float(bitfieldExtract(down.z == 0u ? texel.x : texel.y, int(8u * (down.x + 2u * down.y)), 8));
}

float decide(Ray ray) {
    uint pass = this_step.pass;
    uint first = pass * SAMPLES_PER_PASS;
    bool saturated = texelFetch(accumulated, ivec2(gl_FragCoord.xy), 0).a > frame.termination;
    if (first >= ray.samples || saturated) {
        return DEAD;
    }
    float free = free_distance(ray, first);
    float step_voxels = frame.segment_voxels / float(SAMPLES_PER_PASS);
    // At distance 0 the first sample itself may show something.
    uint next = pass + passes_skipped(free > 0.0 ? free + step_voxels : 0.0);
    bool gone = next >= frame.passes || (EXIT_LOOKAHEAD && next * SAMPLES_PER_PASS >= ray.samples);
    return gone ? DEAD : section_depth(next, next == pass);
}

void main() {
    float depth = DEAD;
    bool runs = may_run();
    if (runs) {
        depth = decide(load_ray());
    }
    DROP_UNLESS(runs);
    MARK(depth);
}
