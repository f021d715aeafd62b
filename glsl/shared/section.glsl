// Sections of the depth range, one a main pass [Thesis §5.3]: the lower half, [0, 0.5), cut into N.
// Twin: src/twin/section.rs. Needs frame.glsl and mark.glsl.

// Where inside its section a mark lies.
#ifdef MARK_FRAGDEPTH_ANY
const float AHEAD = 0.25;
const float ARRIVED = 0.75;
#else
const float AHEAD = 0.5;
const float ARRIVED = 0.5;
#endif

// Depth that marks `section`; `arrived` when it is the one of the pass that marks.
float section_depth(uint section, bool arrived) {
    return (float(section) + (arrived ? ARRIVED : AHEAD)) / (2.0 * float(frame.passes));
}

// What f32 may take from a quotient of a whole number and a step, relative, the step's own rounding included.
const float QUOTIENT_ROUNDING = exp2(-20.0);

// Samples that show nothing, from one on from which `way` voxels are free: those no farther from it, itself among them.
// Where rounding up may take in another, a way is of 508 voxels at the most, and grows by 5e-4; distances leave room for
// more (SLACK in src/structure/grid.rs).
uint free_samples(float way) {
    return uint(floor(way / frame.step_voxels * (1.0 + QUOTIENT_ROUNDING))) + 1u;
}
