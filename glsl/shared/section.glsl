// Sections of the depth range, one a main pass [Thesis §5.3]: the lower half, [0, 0.5), cut into N.
// Twin: src/reference/section.rs. Needs frame.glsl and mark.glsl.

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

// What f32 may take from a quotient of a whole number and a segment, relative, the segment's own rounding included.
const float QUOTIENT_ROUNDING = exp2(-20.0);

// Whole segments of M samples within `way` voxels, which begin at a first sample and end where the first sample lies
// that may show something. At 255 voxels, the largest distance, rounding up reaches 3e-4 voxels; distances leave room
// for more than that (SLACK in src/structure/grid.rs).
uint passes_skipped(float way) {
    return uint(floor(way / frame.segment_voxels * (1.0 + QUOTIENT_ROUNDING)));
}
