// Adaptive sampling: steps as long as the importance volume allows (Weiler03 "Adaptive Sampling"). Twin: src/twin/adaptive.rs. Needs
// samples.glsl, volume.glsl and cell_integral.glsl.

// How often the shortest step is doubled from a cell on, and NOTHING_SHOWS.
layout(set = 0, binding = 71) uniform usampler3D importance;

// Nothing shows all along the step.
const uint NOTHING_SHOWS = 0x80u;

// How often the shortest step is doubled before it is longer than a voxel of the finest spacing; 0 at least.
layout(constant_id = 60) const uint VOXEL_DOUBLINGS = 0u;

// Where a ray is on its adaptive steps.
struct AdaptiveWay {
    // Where the step ends, in steps of the shortest length from the entry point.
    uint at;
    EvenWay on_step;
    // The length of the steps to come, in the shortest ones, and how many are left for which it holds. A step shorter than a voxel is
    // allowed where all of a voxel around is, so that it holds for as many as make one.
    uint stride;
    uint left_over;
};

AdaptiveWay begin_way(Ray ray, uint at) {
    return AdaptiveWay(at, even_way(0.0, sample_volume(ray, float(at)), 0.0), 1u, 0u);
}

// Whether anything is left of the step.
bool in_step(AdaptiveWay way) {
    return way.on_step.gone < 1.0;
}

// Whether anything is left of the ray.
bool goes_on(Ray ray, AdaptiveWay way) {
    return in_step(way) || float(way.at) < ray.steps;
}

// Goes a part of a step further along the ray, or over a step on which nothing shows: its premultiplied colour and opacity.
//
// Parts and not steps, so that rays whose steps have one part need not wait for others.
vec4 adaptive_part(Ray ray, inout AdaptiveWay way) {
    if (!in_step(way)) {
        float begin = float(way.at);
        bool shows = true;
        if (way.left_over == 0u) {
            uint known = texelFetch(importance, cell_of(place_at(ray, begin)), 0).r;
            uint doublings = known & ~NOTHING_SHOWS;
            way.stride = 1u << doublings;
            shows = known < NOTHING_SHOWS;
            way.left_over = shows ? 1u << (VOXEL_DOUBLINGS - min(doublings, VOXEL_DOUBLINGS)) : 1u;
        }
        way.at += way.stride;
        way.left_over -= 1u;
        float end = min(float(way.at), ray.steps);
        // Where nothing shows as well: steps that need it find it in one place.
        way.on_step = even_way(way.on_step.back, sample_volume(ray, end), shows ? (end - begin) * frame.exponent : 0.0);
        if (!shows) {
            return vec4(0.0);
        }
    }
    return next_part(way.on_step);
}
