// The segment of a main pass: M samples, front to back [KW03 §2.1, Thesis §5.2.2]. Twin: src/twin/segment.rs.
// Needs frame.glsl, samples.glsl, volume.glsl, transfer.glsl (PREINTEGRATED: preintegrated.glsl; VALUES: neither),
// opacity.glsl and projection.glsl. SURFACE (with VALUES): surface.glsl. LIT: each sample is lit by its
// gradient [Thesis ch. 7 §7.3]; gradient.glsl and phong.glsl. GRADIENTS: that and its value are in one texture.

#if !defined(PREINTEGRATED) && !defined(VALUES)
// Bring opacities from the reference length to the step.
layout(constant_id = 4) const bool CORRECT_OPACITY = false;
#endif
#ifdef SURFACE
// The part of the step after sample `i` that is on the part of the ray that is drawn, in steps.
vec2 stretch_after(Ray ray, uint i) {
#ifdef LAYERS
    return vec2(max(float(i), ray.begin), min(i + 1u == ray.all ? ray.steps : float(i + 1u), ray.end));
#else
    return vec2(float(i), i + 1u == ray.samples ? ray.steps : float(i + 1u));
#endif
}

// Where the ray's segment for main pass `pass` is on a surface first: steps to the last place in front of it that was looked at, and
// to the first one on it, 0 and opacity 1; nothing where it is on none. Back to front, so that the nearest place is kept
// [KW03 §2.2]. A ray that begins on a surface, or within, meets it there.
//
// Departure: the ends of steps are looked at, the exit point among them, not their begins: a segment then knows both places
// between which it meets the surface.
vec4 segment_color(Ray ray, uint pass) {
    vec4 hit = vec4(0.0);
    uint first = segment_begin(ray, pass);
    uint end = min(pass * SAMPLES_PER_PASS + SAMPLES_PER_PASS, ray.samples);
    for (uint i = end; i > first; --i) {
        vec2 stretch = stretch_after(ray, i - 1u);
        if (level_of(sample_volume(ray, stretch.y)) >= 0) {
            hit = vec4(stretch, 0.0, 1.0);
        }
    }
#ifdef LAYERS
    bool begins = first == ray.first;
#else
    bool begins = first == 0u;
#endif
    if (begins && first < end) {
        float begin = stretch_after(ray, first).x;
        if (level_of(sample_volume(ray, begin)) >= 0) {
            hit = vec4(begin, begin, 0.0, 1.0);
        }
    }
    return hit;
}
#else
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
#ifdef GRADIENTS
    // Value and gradient in one fetch [Stegmaier05 §4].
    vec4 texel = gradient_texel(place_at(ray, steps_to(i)));
    vec4 color = classify(burdened_beside(value_of(texel)), clear);
#else
    vec4 color = classify(sample_volume(ray, steps_to(i)), clear);
#endif
#ifdef LIT
    // What does not show needs no light.
    if (color.a > 0.0) {
        vec3 point = (position_at(ray, steps_to(i)) - 0.5) * frame.extent[0].xyz;
        vec3 view = -texelFetch(direction, ivec2(gl_FragCoord.xy), 0).xyz;
#ifdef GRADIENTS
        vec3 gradient = gradient_of(texel);
#else
        vec3 gradient = gradient_at(place_at(ray, steps_to(i)));
#endif
        color.rgb = lit(color.rgb, gradient, point, view);
    }
#endif
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
#endif
