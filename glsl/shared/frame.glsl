// What every pass of a frame knows: the view, the volume's box and the sampling.
// The Rust side is src/shared/mod.rs; a test compares every member's offset.
//
// Volume space: the longest side of the volume is 1, the centre is the origin.
// Texture space: [0,1]^3 over the volume.

layout(set = 0, binding = 0, std140) uniform Frame {
    // Rays of the view: origin + depth * (base + x * right + y * down), x and y in pixels; volume space. ORTHOGRAPHIC: origin +
    // x * right + y * down + depth * base.
    // Each number is a double-float: the high part in [0], what rounding took from it in [1].
    vec4 origin[2];
    vec4 base[2];
    vec4 right[2];
    vec4 down[2];
    // Sides of the volume in volume space, and their inverses.
    vec4 extent[2];
    vec4 inverse_extent[2];
    // Distance between samples in voxels, for a ray along each axis.
    vec4 voxel_step[2];
    // Voxels along each side.
    vec4 dims;
    // Rays begin at this depth in front of the eye, volume units.
    float near;
    // Samples in a volume unit.
    float inverse_step;
    // Where in its step a sample is taken, in steps.
    float offset;
    // A ray ends when its opacity is greater.
    float termination;
    // step / reference length: the exponent of the opacity correction.
    float exponent;
    // Distance between samples in voxels of the finest spacing.
    float step_voxels;
    // N, main passes of this frame.
    uint passes;
    // The first pixel of the targets in the picture: they are as large as what the box may cover.
    uint first_column;
    uint first_row;
    // x (0..1 over the scalar range) of a value of the volume texture: x_scale * value + x_offset.
    float x_scale;
    float x_offset;
    // Of projections of values, in units of the volume texture: what a ray begins with, and beyond what values differ no
    // more (Levels in src/projection/row.rs).
    float start;
    float end;
} frame;

layout(push_constant) uniform Step {
    // Fragments whose stored depth is greater than this stay out (form `discard`).
    float bound;
    // The main pass this step is, or decides about.
    uint pass;
} this_step;

// M, samples per main pass.
layout(constant_id = 0) const uint SAMPLES_PER_PASS = 8;
