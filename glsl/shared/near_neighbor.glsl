// Near-neighbor skipping [Thesis §5.3]: where along a ray there is work next. Twin: src/twin/near_neighbor.rs.
// Needs frame.glsl, mark.glsl, double_float.glsl, samples.glsl, section.glsl and (without DENSE) distance.glsl.
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
layout(constant_id = 6) const bool EXIT_LOOKAHEAD = true;
// How often a ray may look in a segment.
layout(constant_id = 9) const uint LOOKUPS = 1;

// The section in which a ray that arrives at `section` next has work; N, which is none, when it is gone.
uint next_section(Ray ray, uint section) {
    uint i = segment_begin(ray, section);
    uint end = min(segment_end(i), ray.samples);
    if (i >= end) {
        return frame.passes;
    }
    // Asked at the end as well: segment.glsl.
    for (uint looked = 0u; looked < LOOKUPS && i < end;) {
        uint free = free_from(ray, i);
        i += free;
        ++looked;
        if (free == 0u || looked >= LOOKUPS || i >= end) {
            break;
        }
    }
    bool gone = EXIT_LOOKAHEAD && i >= ray.samples;
    return gone ? frame.passes : min(i / SAMPLES_PER_PASS, frame.passes);
}
#endif

// The depth that says so; `arrived` when it is the section of the pass that marks.
float decision_depth(uint next, bool arrived) {
    return next < frame.passes ? section_depth(next, arrived) : DEAD;
}
