// The segment of a main pass: M samples, front to back [KW03 §2.1, Thesis §5.2.2]. Twin: src/twin/segment.rs.
// Needs what shade.glsl needs, and that.
//
// This loop and others of few turns ask at both ends whether they go on. Drivers that run lanes under masks (llvmpipe, SwiftShader) run the
// body of a loop that asks at its beginning only once more, for no lane, which takes as long as another sample. A loop that asked at its end
// only would be wrong there: they run its body again for lanes that have left it, along with the others, and lose what those lanes held.

#ifdef SURFACE
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
    for (uint i = end; i > first;) {
        --i;
        vec2 stretch = stretch_after(ray, i);
        if (on_surface(ray, stretch.y)) {
            hit = vec4(stretch, 0.0, 1.0);
        }
        if (i <= first) {
            break;
        }
    }
    if (first == first_sample(ray) && first < end) {
        float begin = stretch_after(ray, first).x;
        if (on_surface(ray, begin)) {
            hit = vec4(begin, begin, 0.0, 1.0);
        }
    }
    return hit;
}
#else
// What the ray's segment for main pass `pass` brings to the pixel; nothing where the ray has left the volume.
vec4 segment_color(Ray ray, uint pass) {
    vec4 segment = no_sample();
    uint first = segment_begin(ray, pass);
    uint end = min(pass * SAMPLES_PER_PASS + SAMPLES_PER_PASS, ray.samples);
#ifdef PREINTEGRATED
    float front = first < end ? node_at(ray, first) : 0.0;
#endif
    for (uint i = first; i < end;) {
#ifdef PREINTEGRATED
        segment = joined(segment, shade_span(ray, i, front));
#else
        segment = joined(segment, shade_sample(ray, i));
#endif
        ++i;
        if (i >= end) {
            break;
        }
    }
    return segment;
}
#endif
