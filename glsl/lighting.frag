// The lighting pass of iso-surfaces, once for all rays [Thesis ch. 5 §3.2]: of each ray that has met a surface, the exact place of it
// between the two samples that enclose it, its normal along the gradient there, and its colour in all lights, under what is in front
// of it. SHOWS_POSITION: in place of the colour the exact place; SHOWS_NORMAL: the normal, turned to the eye; both in volume space.
// ENVIRONMENT: the colour is mixed with that of what the surface reflects.
//
//@takes [SHOWS_POSITION | SHOWS_NORMAL], [GRADIENTS], [ENVIRONMENT]
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/opacity.glsl"
#include "shared/surface.glsl"
#include "shared/root.glsl"
#ifndef SHOWS_POSITION
#include "shared/gradient.glsl"
#endif
#if !defined(SHOWS_POSITION) && !defined(SHOWS_NORMAL)
#include "shared/phong.glsl"
#endif
#ifdef ENVIRONMENT
#include "shared/environment.glsl"
#endif

layout(set = 0, binding = 7) uniform sampler2D surface_hit;

// How the place of the surface is found between the two (`Refine` in src/scene/settings/surface.rs).
const int NONE = 0;
const int LINEAR = 1;
const int CUBIC = 2;
layout(constant_id = 20) const int REFINE = LINEAR;

layout(location = 0) out vec4 accumulated;

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
    for (int i = 0; i < surface_levels.list.length(); ++i) {
        SurfaceLevel one = surface_levels.list[i];
        float value = rises ? one.from : one.to;
        bool ahead = rises ? value > front : value < front;
        if (ahead && (level < 0 || (rises ? value < met : value >= met))) {
            level = i;
            met = value;
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

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 hit = texelFetch(surface_hit, pixel, 0);
    if (hit.a == 0.0) {
        discard;
    }
    Ray ray = load_ray();
    Meeting met = meet(ray, hit.xy);
#ifndef SHOWS_POSITION
    vec3 gradient = gradient_at(place_at(ray, met.steps));
#endif
    vec3 point = (position_at(ray, met.steps) - 0.5) * frame.extent[0].xyz;
    vec3 view = -texelFetch(direction, pixel, 0).xyz;
#if defined(SHOWS_POSITION)
    accumulated = vec4(point, 1.0);
#elif defined(SHOWS_NORMAL)
    accumulated = vec4(normal_to(view, gradient), 1.0);
#else
    accumulated = vec4(lit(surface_levels.list[met.level].color.rgb, gradient, point, view), 1.0);
#ifdef ENVIRONMENT
    accumulated.rgb = reflecting(accumulated.rgb, gradient, view);
#endif
#endif
}
