// The whole ray in one loop [Stegmaier05 §3, §5]: samples are taken until the ray leaves the volume or needs no more of them.
// Twin: src/twin/single_pass.rs. It includes all it needs, which two shaders would have to list alike.
//
// ADAPTIVE: steps have lengths of their own (Weiler03 "Adaptive Sampling").
//
// TRANSPARENT (with SURFACE; crossings.glsl): surfaces let something through, and the ray goes on behind them.
// LEAP_BLOCKS, LEAP_DISTANCES: every M samples the loop looks at blocks or distances, and leaps over samples that show nothing until it
// comes to some that may.
//
// Departures: 1. positions come from the index, where the paper adds steps up. 2. The end of the ray is drawn, unless `last = "none"`
// asks for the paper's way, which stops before the volume is left. 3. T is tested after every sample; multi-pass ray casters test it
// between passes only.

#define OWN_RAYS

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#include "shared/volume.glsl"
#include "shared/opacity.glsl"
#include "shared/projection.glsl"
#ifdef PREINTEGRATED
#include "shared/preintegrated.glsl"
#elif !defined(VALUES)
#include "shared/transfer.glsl"
#endif
#if defined(LIT) || defined(REFRACTION) || defined(SURFACE) && !defined(SHOWS_POSITION)
#include "shared/gradient.glsl"
#endif
#ifdef SURFACE
#include "shared/surface.glsl"
#endif
#if defined(SHADOWS) || defined(TRANSLUCENT) || defined(REFRACTION)
#include "shared/way_out.glsl"
#endif
#ifdef REFRACTION
#include "shared/refraction.glsl"
#endif
#ifdef BACKDROP
#include "shared/backdrop.glsl"
#endif
#if defined(SHADOWS) || defined(TRANSLUCENT)
#include "shared/light_path.glsl"
#endif
#if defined(LIT) || defined(SURFACE) && !defined(SHOWS_POSITION) && !defined(SHOWS_NORMAL)
#include "shared/phong.glsl"
#endif
#ifdef ENVIRONMENT
#include "shared/environment.glsl"
#endif
#ifdef EFFECT
#include "shared/effect.glsl"
#endif
#ifdef SURFACE
#include "shared/root.glsl"
#include "shared/surface_color.glsl"
#endif
#ifdef CLIP_VOLUME
#include "shared/clip_volume.glsl"
#endif
#ifdef LEAP_DISTANCES
#include "shared/free.glsl"
#include "shared/distance.glsl"
#elif defined(LEAP_BLOCKS)
#include "shared/block.glsl"
#include "shared/visible_block.glsl"
#endif
#ifdef ADAPTIVE
#include "shared/logarithm.glsl"
#include "shared/cell_integral.glsl"
#include "shared/adaptive.glsl"
#else
#include "shared/shade.glsl"
#endif

// What a ray holds before its first sample.
vec4 begin_ray(Ray ray) {
#if defined(VALUES) && !defined(SURFACE)
    // A ray so short that it takes no sample holds what no sample can change, as in start.frag.
    bool least = PROJECTION == MINIP && ray.samples == 0u;
    return vec4(least ? vec3(x_of(frame.end)) : no_sample().rgb, 1.0);
#else
    return vec4(0.0);
#endif
}

// Whether a ray that holds so much takes no further sample. One that looks for a surface goes on to it behind whatever lets
// something through, as in the passes of main_pass.frag.
bool is_done(vec4 held) {
#if defined(SURFACE) && !defined(TRANSPARENT)
    return held.a >= 1.0;
#elif defined(ENDLESS)
    return false;
#else
    return ended(held, 0.0);
#endif
}

#if defined(TRANSPARENT)
#include "shared/crossings.glsl"
#elif defined(SURFACE)
// Whether the ray meets a surface where it begins.
bool begins_on_surface(Ray ray, float begin) {
#ifdef CLIP_VOLUME
    if (!is_kept(ray, begin)) {
        return false;
    }
#endif
    return on_surface(ray, begin);
}

// Joins the step after sample `i` with what the ray holds: the surface that it meets there, if any, which ends the ray.
bool take_step(Ray ray, uint i, inout vec4 held) {
    vec2 stretch = stretch_after(ray, i);
#ifdef CLIP_VOLUME
    KeptPart part = kept_part(ray, stretch);
    if (!part.any_part) {
        return false;
    }
    stretch = part.between;
    if (part.enters && on_surface(ray, stretch.x)) {
        // It is met where the ray comes to it.
        stretch.y = stretch.x;
    }
#endif
    if (!on_surface(ray, stretch.y)) {
        return false;
    }
    held = joined(held, surface_color(ray, stretch));
    return true;
}
#endif

#ifdef ADAPTIVE
// Steps of the ray, joined with what it holds already.
vec4 gather(Ray ray, vec4 held) {
    AdaptiveWay way = begin_way(ray, 0u);
    bool done = is_done(held);
    while (!done && goes_on(ray, way)) {
        held = joined(held, adaptive_part(ray, way));
        // T is tested after whole steps.
        done = in_step(way) ? held.a >= 1.0 : is_done(held);
        if (done || !goes_on(ray, way)) {
            break;
        }
    }
    return held;
}
#else
// Samples of the ray from its first one on, joined with what it holds already; the ray ends where it has bent last.
vec4 gather(inout Ray ray, vec4 held) {
    uint i = first_sample(ray);
    bool done = is_done(held);
#ifdef REFRACTION
    begin_bending(ray);
#endif
#if defined(TRANSPARENT)
#ifndef GOES_ON
    if (!done && i < ray.samples) {
        cross_begin(ray, stretch_after(ray, i).x, held);
        done = is_done(held);
    }
#endif
#elif defined(SURFACE)
    // A ray that begins on a surface, or within, meets it there.
    if (!done && i < ray.samples) {
        float begin = stretch_after(ray, i).x;
        if (begins_on_surface(ray, begin)) {
            held = joined(held, surface_color(ray, vec2(begin)));
            done = true;
        }
    }
#endif
    // Asked at the end as well, here and within: segment.glsl.
    while (!done && i < ray.samples) {
#if defined(LEAP_BLOCKS) || defined(LEAP_DISTANCES)
        // Rays that a device shades together leap together, and then sample together.
        for (uint free = 1u; free > 0u && i < ray.samples;) {
            free = free_from(ray, i);
            i += free;
            if (free == 0u || i >= ray.samples) {
                break;
            }
        }
        uint end = min(i + SAMPLES_PER_PASS, ray.samples);
#else
        uint end = ray.samples;
#endif
#ifdef TRANSPARENT
        float front = crossed_value(ray, stretch_after(ray, i).x);
#elif defined(PREINTEGRATED)
        float front = node_at(ray, i);
#endif
        while (!done && i < end) {
#ifdef REFRACTION
            bend(ray, i);
            // It may leave the volume sooner; where it does so later, the loop around goes on.
            end = min(end, max(ray.samples, i + 1u));
#endif
#if defined(TRANSPARENT)
            cross_step(ray, i, front, held);
            done = is_done(held);
#elif defined(SURFACE)
            done = take_step(ray, i, held);
#elif defined(PREINTEGRATED)
            held = joined(held, shade_span(ray, i, front));
            done = is_done(held);
#else
            held = joined(held, shade_sample(ray, i));
            done = is_done(held);
#endif
            ++i;
            if (done || i >= end) {
                break;
            }
        }
        if (done || i >= ray.samples) {
            break;
        }
    }
    return held;
}
#endif

// The picture of the ray, with what it holds already.
vec4 cast_ray(Ray ray, vec4 held) {
    held = gather(ray, held);
#ifdef BACKDROP
#ifdef REFRACTION
    // One that has ended early goes on straight.
    vec3 behind = ray.bent ? backdrop_met((ray.entry - 0.5) * frame.extent[0].xyz, ray.direction) : backdrop_straight(this_pixel());
#else
    vec3 behind = backdrop_straight(this_pixel());
#endif
    held = joined(held, vec4(behind, 1.0));
#endif
    return held;
}
