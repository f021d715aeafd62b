// How many samples a free way has room for. Twin: `free_samples` in src/twin/section.rs. Needs frame.glsl.

// What f32 may take from a quotient of a whole number and a step, relative, the step's own rounding included.
const float QUOTIENT_ROUNDING = exp2(-20.0);

// Samples that show nothing, `stride` steps apart, from one on from which `way` voxels are free: those no farther from it, itself among
// them.
// Where rounding up may take in another, a way is of 508 voxels at the most, and grows by 5e-4; distances leave room for
// more (SLACK in src/structure/grid.rs).
uint free_samples(float way, float stride) {
    return uint(floor(way / (frame.step_voxels * stride) * (1.0 + QUOTIENT_ROUNDING))) + 1u;
}
