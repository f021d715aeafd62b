// The segment of a main pass: M samples, front to back [KW03 §2.1, Thesis §5.2.2]. Twin: src/twin/segment.rs.
// Needs frame.glsl, samples.glsl, volume.glsl, transfer.glsl (PREINTEGRATED: preintegrated.glsl; VALUES: neither),
// opacity.glsl and projection.glsl.

#if !defined(PREINTEGRATED) && !defined(VALUES)
// Bring opacities from the reference length to the step.
layout(constant_id = 4) const bool CORRECT_OPACITY = false;
#endif
// Steps that sample `i` stands for.
float extent_of_sample(Ray ray, uint i) {
#ifdef LAYERS
    float to = min(i + 1 == ray.all ? ray.steps : float(i + 1), ray.end);
    return LAST_PARTIAL ? to - max(float(i), ray.begin) : 1.0;
#else
    return LAST_PARTIAL && i + 1 == ray.samples ? ray.steps - float(i) : 1.0;
#endif
}

#ifdef PREINTEGRATED
// Premultiplied colour of the ray's segment for main pass `pass`; transparent where the ray has left the volume. Sample
// `i` stands for all values from its own to that of the next sample, or of the exit point.
vec4 segment_color(Ray ray, uint pass) {
    vec4 segment = no_sample();
    uint first = segment_begin(ray, pass);
    uint end = min(pass * SAMPLES_PER_PASS + SAMPLES_PER_PASS, ray.samples);
    float front = first < end ? node_of(sample_volume(ray, steps_to(first))) : 0.0;
    for (uint i = first; i < end; ++i) {
        float back = node_of(sample_volume(ray, min(steps_to(i + 1u), ray.steps)));
        segment = joined(segment, part_of(classify_between(front, back), extent_of_sample(ray, i)));
        front = back;
    }
    return segment;
}
#else
#ifdef VALUES
// What sample `i` brings to its ray.
vec4 shade_sample(Ray ray, uint i) {
    if (in_hole(ray, i)) {
        return no_sample();
    }
    float all = LAST_PARTIAL ? ray.steps : float(ray.samples);
    return value_sample(sample_volume(ray, steps_to(i)), extent_of_sample(ray, i), all);
}
#else
// Premultiplied colour of sample `i`.
vec4 shade_sample(Ray ray, uint i) {
    if (in_hole(ray, i)) {
        return no_sample();
    }
    float clear;
    vec4 color = classify(sample_volume(ray, steps_to(i)), clear);
    float steps = extent_of_sample(ray, i);
    color.a = CORRECT_OPACITY ? corrected_opacity(color.a, clear, frame.exponent * steps) : min(color.a * steps, 1.0);
    return vec4(color.rgb * color.a, color.a);
}
#endif

// What the ray's segment for main pass `pass` brings to the pixel; nothing where the ray has left the volume.
vec4 segment_color(Ray ray, uint pass) {
    vec4 segment = no_sample();
    uint first = segment_begin(ray, pass);
    uint end = min(pass * SAMPLES_PER_PASS + SAMPLES_PER_PASS, ray.samples);
    for (uint i = first; i < end; ++i) {
        segment = joined(segment, shade_sample(ray, i));
    }
    return segment;
}
#endif
