// Near-neighbor skipping [Thesis §5.3]: where along a ray there is work next. Twin: src/reference/near_neighbor.rs.
// Needs frame.glsl, mark.glsl, double_float.glsl, samples.glsl and section.glsl.
//
// Departures: 1. distances are bounds for the trilinear footprint, not from voxel to voxel. 2. EXIT_LOOKAHEAD:
// a ray that will have left the volume by then is dead at once. 3. all samples within the distance are free, so the
// first that may show something is a step beyond the last of them.

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

// The section in which a ray that arrives at `section` next has work; N, which is none, when it is gone.
uint next_section(Ray ray, uint section) {
    uint first = section * SAMPLES_PER_PASS;
    if (first >= ray.samples) {
        return frame.passes;
    }
    float free = free_distance(ray, first);
    float step_voxels = frame.segment_voxels / float(SAMPLES_PER_PASS);
    // At distance 0 the first sample itself may show something.
    uint next = section + passes_skipped(free > 0.0 ? free + step_voxels : 0.0);
    bool gone = EXIT_LOOKAHEAD && next * SAMPLES_PER_PASS >= ray.samples;
    return gone ? frame.passes : min(next, frame.passes);
}

// The depth that says so; `arrived` when it is the section of the pass that marks.
float decision_depth(uint next, bool arrived) {
    return next < frame.passes ? section_depth(next, arrived) : DEAD;
}
