// How the samples of a ray become its pixel, a case for each row of src/projection, which is the twin. Needs frame.glsl and
// opacity.glsl.

// The codes of the rows.
const int COMPOSITE = 0;
layout(constant_id = 15) const int PROJECTION = COMPOSITE;

// What a segment holds before its first sample: joined with a pixel it changes nothing.
vec4 no_sample() {
    return vec4(0.0);
}

// A sample with those in front of it in its segment, and a segment with what a pixel holds, as the blend unit does it.
vec4 joined(vec4 front, vec4 behind) {
    return composite(front, behind);
}

// Whether a ray whose pixel holds that needs no further samples, by a `margin` where that is a matter of opacity.
bool ended(vec4 held, float margin) {
    return held.a > frame.termination + margin;
}
