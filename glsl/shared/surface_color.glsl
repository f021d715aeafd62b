// Where a ray meets an iso-surface between two places, and what it looks like there [Thesis ch. 5 §3.2]. Twin: src/twin/lighting.rs.
// Needs frame.glsl, samples.glsl, volume.glsl, surface.glsl and root.glsl; without SHOWS_POSITION gradient.glsl; without that and
// SHOWS_NORMAL phong.glsl; with ENVIRONMENT environment.glsl; with EFFECT effect.glsl.

// How the place of the surface is found between the two (`Refine` in src/scene/settings/surface.rs).
const int NONE = 0;
const int LINEAR = 1;
const int CUBIC = 2;
layout(constant_id = 20) const int REFINE = LINEAR;

// A place on a surface: steps from the entry point, and which surface it is.
struct Meeting {
    float steps;
    int level;
};

// The surface that is met first between two places, in steps: one in front of it and one on it, or twice the place in which the
// ray begins.
Meeting meet(Ray ray, vec2 between) {
    float front = sample_volume(ray, between.x);
    float back = sample_volume(ray, between.y);
    int level = level_of(front);
    if (level >= 0) {
        return Meeting(between.x, level);
    }
    // The first value of a surface on the way from one to the other.
    bool rises = front < back;
    float met = 0.0;
    int count = surface_levels.list.length();
    // Asked at the end as well: segment.glsl.
    for (int i = 0; i < count;) {
        SurfaceLevel one = surface_levels.list[i];
        float value = rises ? one.from : one.to;
        bool ahead = rises ? value > front : value < front;
        if (ahead && (level < 0 || (rises ? value < met : value >= met))) {
            level = i;
            met = value;
        }
        ++i;
        if (i >= count) {
            break;
        }
    }
    if (level < 0 || REFINE == NONE) {
        return Meeting(between.y, max(level, 0));
    }
    if (REFINE == LINEAR) {
        return Meeting(mix(between.x, between.y, clamp((met - front) / (back - front), 0.0, 1.0)), level);
    }
    return Meeting(first_at(ray, between, met, rises ? 1.0 : -1.0), level);
}

#ifdef SHOWS_NORMAL
// The unit vector along a gradient that is turned to the eye, as `lit` takes it; 0 where there is no gradient.
vec3 normal_to(vec3 view, vec3 gradient) {
    float steepest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    vec3 normal = steepest > 0.0 ? normalize(gradient / steepest) : vec3(0.0);
    return dot(normal, view) < 0.0 ? -normal : normal;
}
#endif

// What shows of a surface where the ray meets it, premultiplied.
vec4 color_where(Ray ray, Meeting met) {
#ifndef SHOWS_POSITION
    vec3 gradient = gradient_at(place_at(ray, met.steps));
#endif
    vec3 point = (position_at(ray, met.steps) - 0.5) * frame.extent[0].xyz;
    vec3 view = -ray.direction;
#if defined(SHOWS_POSITION)
    return vec4(point, 1.0);
#elif defined(SHOWS_NORMAL)
    return vec4(normal_to(view, gradient), 1.0);
#else
    vec4 unlit = surface_levels.list[met.level].color;
    vec3 color = lit(unlit.rgb, gradient, point, view);
#ifdef ENVIRONMENT
    color = reflecting(color, gradient, view);
#endif
#ifdef EFFECT
    color = affected_surface(ray, met.steps, met.level, color);
#endif
    return vec4(color * unlit.a, unlit.a);
#endif
}

// What shows of a surface that the ray meets between two places, as `meet` has them.
vec4 surface_color(Ray ray, vec2 between) {
    return color_where(ray, meet(ray, between));
}
