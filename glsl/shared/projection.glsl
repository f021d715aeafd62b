// How the samples of a ray become its pixel: a code for each row of src/projection, which is the twin, and a case in each of
// the functions below but `x_of`; in `no_sample` only where the blend is an extreme, in `ended` only where rays end by it.
// `frame.exponent` is the reference lengths in a step. Needs frame.glsl and opacity.glsl.

// The codes of the rows.
const int COMPOSITE = 0;
const int MIP = 1;
const int MINIP = 2;
const int AVERAGE = 3;
const int XRAY = 4;
layout(constant_id = 15) const int PROJECTION = COMPOSITE;

// x of a value of the volume texture. In this order, so that a greater value never has a lesser x.
float x_of(float value) {
    precise float x = fma(value, frame.x_scale, frame.x_offset);
    return x;
}

// What a segment holds before its first sample: joined with a pixel it changes nothing.
vec4 no_sample() {
    bool extreme = PROJECTION == MIP || PROJECTION == MINIP;
    return extreme ? vec4(vec3(x_of(frame.start)), 1.0) : vec4(0.0);
}

// A sample with those in front of it in its segment, and a segment with what a pixel holds, as the blend unit does it.
vec4 joined(vec4 front, vec4 behind) {
    switch (PROJECTION) {
    case MIP:
        return max(front, behind);
    case MINIP:
        return min(front, behind);
    case AVERAGE:
    case XRAY:
        return front + behind;
    default:
        return composite(front, behind);
    }
}

// Read once, before loops (transfer.glsl).
float ends_above = frame.termination;

// Whether a ray whose pixel holds that needs no further samples, by a `margin` where that is a matter of opacity.
bool ended(vec4 held, float margin) {
    switch (PROJECTION) {
    case MIP:
        return held.r >= x_of(frame.end);
    case MINIP:
        return held.r <= x_of(frame.end);
    case AVERAGE:
    case XRAY:
        return false;
    default:
        return held.a > ends_above + margin;
    }
}

// What a sample of that value brings, where values are shown: it stands for so many `steps` of `all` those of its ray.
vec4 value_sample(float value, float steps, float all) {
    // What rounding cannot tell from 0 counts as 0.
    bool zero = abs(value - frame.start) <= frame.end - frame.start;
    switch (PROJECTION) {
    case MIP:
        return vec4(vec3(x_of(min(value, frame.end))), 1.0);
    case MINIP:
        return vec4(vec3(x_of(max(value, frame.end))), 1.0);
    case AVERAGE:
        return zero ? vec4(0.0) : vec4(vec3(x_of(value) * (steps / all)), 0.0);
    case XRAY:
        return zero ? vec4(0.0) : vec4(vec3(x_of(value) * (steps * frame.exponent)), 0.0);
    default:
        return vec4(0.0);
    }
}

#ifdef READS_GATHERED
// What a ray has gathered, which tells whether it has ended: its colour, or with SURFACE where it has met a surface, with opacity 1.
// Twin: `gathered` in src/twin/surface.rs.
#ifdef SURFACE
layout(set = 0, binding = 7) uniform sampler2D surface_hit;
#define GATHERED surface_hit
#else
layout(set = 0, binding = 7) uniform sampler2D accumulated;
#define GATHERED accumulated
#endif
#endif
