// What samples bring to their ray. Twin: src/twin/segment.rs, of SURFACE src/twin/surface.rs.
// Needs frame.glsl, samples.glsl, volume.glsl, transfer.glsl (PREINTEGRATED: preintegrated.glsl; VALUES: neither),
// opacity.glsl and projection.glsl. SURFACE (with VALUES, unless IN_VOLUME): surface.glsl. LIT: each sample is lit by its
// gradient [Thesis ch. 7 §7.3]; gradient.glsl and phong.glsl. GRADIENTS: that and its value are in one texture. EFFECT:
// effect.glsl. CLIP_VOLUME: a sample that is clipped counts as nothing, for its whole step; clip_volume.glsl.

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

// Whether the ray is on a surface `steps` from the entry point.
bool on_surface(Ray ray, float steps) {
    return level_of(sample_volume(ray, steps)) >= 0;
}
#else
// Steps that sample `i` stands for.
float extent_of_sample(Ray ray, uint i) {
#if defined(SLICES) && defined(VALUES)
    return ray.stride;
#elif defined(SLICES)
    // Opacities that are taken as they stand are those of a slice.
    return CORRECT_OPACITY ? ray.stride : 1.0;
#elif defined(LAYERS)
    float to = min(i + 1 == ray.all ? ray.steps : float(i + 1), ray.end);
    return LAST_PARTIAL ? to - max(float(i), ray.begin) : 1.0;
#else
    return LAST_PARTIAL && i + 1 == ray.samples ? ray.steps - float(i) : 1.0;
#endif
}

#endif

#if defined(SURFACE) && !defined(IN_VOLUME)
// Samples tell where surfaces are, and have no colour.
#elif defined(PREINTEGRATED)
#ifndef SURFACE
// The value at sample `i`, or at the exit point, on the table's axes.
float node_at(Ray ray, uint i) {
#ifdef SLICES
    // On the next slice, which may be outside, the value is that of the face before it.
    if (i > 0u) {
        ray = ray_on_slice(ray.pixel, ray.slice + 1.0, FILTER != HARDWARE);
    }
    return node_of(sample_volume(ray, 0.0));
#else
    return node_of(sample_volume(ray, min(steps_to(i), ray.steps)));
#endif
}

// Premultiplied colour of sample `i`, which stands for all values from its own, `front` on the table's axes, to that of the next
// sample or of the exit point; `front` becomes the latter.
vec4 shade_span(Ray ray, uint i, inout float front) {
    float back = node_at(ray, i + 1u);
    vec4 color = part_of(classify_between(front, back), extent_of_sample(ray, i));
#ifdef CLIP_VOLUME
    if (!is_kept(ray, steps_to(i))) {
        color = vec4(0.0);
    }
#endif
    front = back;
    return color;
}
#endif
#elif defined(VALUES)
// What sample `i` brings to its ray.
vec4 shade_sample(Ray ray, uint i) {
#ifdef CLIP_VOLUME
    if (!is_kept(ray, steps_to(i))) {
        return no_sample();
    }
#endif
    if (in_hole(ray, i)) {
        return no_sample();
    }
    float all = LAST_PARTIAL ? ray.steps : float(ray.samples) * stride_of(ray);
    return value_sample(sample_volume(ray, steps_to(i)), extent_of_sample(ray, i), all);
}
#else
// Colour of sample `i`, not premultiplied, with the opacity of a reference length; `clear` is 1 - opacity.
vec4 color_of_sample(Ray ray, uint i, out float clear) {
#if defined(GRADIENTS) && !defined(SURFACE)
    // Value and gradient in one fetch [Stegmaier05 §4].
    vec4 texel = gradient_texel(place_at(ray, steps_to(i)));
    float value = burdened_beside(value_of(texel));
#else
    float value = sample_volume(ray, steps_to(i));
#endif
    vec4 color = classify(value, clear);
#ifdef LIT
    // What does not show needs no light.
    if (color.a > 0.0) {
        vec3 point = (position_at(ray, steps_to(i)) - 0.5) * frame.extent[0].xyz;
        vec3 view = -ray.direction;
#ifdef GRADIENTS
        vec3 gradient = gradient_of(texel);
#else
        vec3 gradient = gradient_at(place_at(ray, steps_to(i)));
#endif
        color.rgb = lit(color.rgb, gradient, point, view);
    }
#endif
#ifdef EFFECT
    color = affected_sample(ray, steps_to(i), value, color, clear);
#endif
    return color;
}

// Such a colour for so many steps, premultiplied.
vec4 over_steps(vec4 color, float clear, float steps) {
    color.a = CORRECT_OPACITY ? corrected_opacity(color.a, clear, frame.exponent * steps) : min(color.a * steps, 1.0);
    return vec4(color.rgb * color.a, color.a);
}

#ifndef SURFACE
// Premultiplied colour of sample `i`.
vec4 shade_sample(Ray ray, uint i) {
#ifdef CLIP_VOLUME
    if (!is_kept(ray, steps_to(i))) {
        return no_sample();
    }
#endif
    if (in_hole(ray, i)) {
        return no_sample();
    }
    float clear;
    vec4 color = color_of_sample(ray, i, clear);
    return over_steps(color, clear, extent_of_sample(ray, i));
}
#endif
#endif
