// Main pass: ray traversal [KW03 §2.1, Thesis §5.2.2]. M samples of the ray's segment for this pass, composited
// front to back; the blend unit puts the segment under what the pixel has already.
//
// Departure: a ray that has left the volume takes no samples, and the intermediate pass knows its length; KW03
// writes opacity 1 to RES for it, which would change the picture.
#version 460
#extension GL_GOOGLE_include_directive : require
//@variant plain
//@variant holes HOLES
//@variant discard CULL_DISCARD
//@variant discard+holes CULL_DISCARD HOLES

#include "shared/frame.glsl"
#include "shared/cull.glsl"
#include "shared/double_float.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/transfer.glsl"
#include "shared/opacity.glsl"

#ifndef CULL_DISCARD
layout(early_fragment_tests) in;
#endif

// Bring opacities from the reference length to the step.
layout(constant_id = 4) const bool CORRECT_OPACITY = false;
// The last sample stands for what is left of the ray only.
layout(constant_id = 5) const bool LAST_PARTIAL = false;

layout(location = 0) out vec4 accumulated;

// Steps that sample `i` stands for.
float extent_of_sample(Ray ray, uint i) {
    return LAST_PARTIAL && i + 1 == ray.samples ? ray.steps - float(i) : 1.0;
}

// Premultiplied colour of sample `i`.
vec4 shade_sample(Ray ray, uint i) {
    if (in_hole(ray, i)) {
        return vec4(0.0);
    }
    vec4 color = classify(sample_volume(ray, i));
    float steps = extent_of_sample(ray, i);
    color.a = CORRECT_OPACITY ? corrected_opacity(color.a, frame.exponent * steps) : min(color.a * steps, 1.0);
    return vec4(color.rgb * color.a, color.a);
}

void main() {
    vec4 segment = vec4(0.0);
    bool runs = may_run();
    if (runs) {
        Ray ray = load_ray();
        uint first = this_step.pass * SAMPLES_PER_PASS;
        uint end = min(first + SAMPLES_PER_PASS, ray.samples);
        for (uint i = first; i < end; ++i) {
            segment = composite(segment, shade_sample(ray, i));
        }
    }
    DROP_UNLESS(runs);
    accumulated = segment;
}
