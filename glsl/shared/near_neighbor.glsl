// Near-neighbor skipping [Thesis §5.3]: where along a ray there is work next. Twin: src/twin/near_neighbor.rs.
// Needs frame.glsl, mark.glsl, double_float.glsl, samples.glsl and section.glsl.
//
// Departures: 1. distances are bounds for the trilinear footprint, not from voxel to voxel; and since they hold from
// everywhere in a cell, they are counted from where the ray leaves its cell. 2. All samples that lie within are free, so
// the first that may show something is a step beyond the last of them. 3. EXIT_LOOKAHEAD: a ray that has no sample left
// by then is dead at once. 4. LOOKUPS: a ray whose next work would lie in the same segment may look again from there.

// DENSE: every cell is interesting, there is no structure, and a ray has work wherever it has samples.

#ifdef DENSE
uint next_section(Ray ray, uint section) {
    uint i = segment_begin(ray, section);
    return i < ray.samples ? i / SAMPLES_PER_PASS : frame.passes;
}
#else
// Of each cell a byte, or eight bytes in two words, one for each octant: 0 where the cell is interesting, else one more
// than the voxels of the finest spacing that a ray may go from anywhere in the cell.
layout(set = 0, binding = 10) uniform usampler3D nearest_distance;

layout(constant_id = 6) const bool EXIT_LOOKAHEAD = true;
// Side of a cell of the structure, in voxels.
layout(constant_id = 7) const int CELL = 1;
// The structure tells octants apart.
layout(constant_id = 8) const bool OCTANTS = false;
// A sample stands for all values up to the next one (preintegrated.glsl).
layout(constant_id = 12) const bool SPANS = false;
// How often a ray may look in a segment.
layout(constant_id = 9) const uint LOOKUPS = 1;

// The largest distance there is, and the longest way inside a cell that is counted, in voxels.
const float FAR = 254.0;

// The byte of the structure's cell `box`.
uint byte_of(Ray ray, ivec3 box) {
    uvec2 texel = texelFetch(nearest_distance, box, 0).rg;
    if (!OCTANTS) {
        return texel.x;
    }
    uvec3 down = uvec3(lessThan(ray.step_vector, vec3(0.0)));
    return bitfieldExtract(down.z == 0u ? texel.x : texel.y, int(8u * (down.x + 2u * down.y)), 8);
}

// Samples from `i` on that show nothing.
uint free_from(Ray ray, uint i) {
    Place place = place_at(ray, steps_to(i));
    ivec3 box = cell_of(place) / CELL;
    uint byte = byte_of(ray, box);
    if (byte == 0u) {
        return 0u;
    }
    float inside = min(steps_inside(ray, place, box, CELL) * frame.step_voxels, FAR);
    uint free = free_samples(inside + float(byte - 1u));
    // What lies between the last free sample and the next one need not be free.
    return SPANS ? free - 1u : free;
}

// The section in which a ray that arrives at `section` next has work; N, which is none, when it is gone.
uint next_section(Ray ray, uint section) {
    uint i = segment_begin(ray, section);
    uint end = min(segment_end(i), ray.samples);
    if (i >= end) {
        return frame.passes;
    }
    for (uint looked = 0u; looked < LOOKUPS && i < end; ++looked) {
        uint free = free_from(ray, i);
        if (free == 0u) {
            break;
        }
        i += free;
    }
    bool gone = EXIT_LOOKAHEAD && i >= ray.samples;
    return gone ? frame.passes : min(i / SAMPLES_PER_PASS, frame.passes);
}
#endif

// The depth that says so; `arrived` when it is the section of the pass that marks.
float decision_depth(uint next, bool arrived) {
    return next < frame.passes ? section_depth(next, arrived) : DEAD;
}
