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
