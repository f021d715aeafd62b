// Samples along a ray: how many and where. Twin: src/twin/samples.rs. Needs frame.glsl, double_float.glsl, pixel.glsl and
// layer.glsl. OWN_RAYS: the ray is found here, not in passes before; ray.glsl. SLICES: and samples lie on slices.

#ifdef SLICES
#define OWN_RAYS
#endif
#if defined(LAYER_BEFORE) || defined(SLICES)
// Samples are counted from before where the ray, or its part that is drawn, begins.
#define BEGINS_LATE
#endif

#ifndef OWN_RAYS
layout(set = 0, binding = 1) uniform sampler2D entry;
layout(set = 0, binding = 2) uniform sampler2D direction;
#endif

// Bits cleared of a part of a step: 9 are left, so that their product with up to 2^15 steps is exact.
const int STRIDE_CLEARED = 15;

struct Ray {
    // Unit vector along the ray, volume space.
    vec3 direction;
    // Texture coordinates of the entry point, and from one sample to the next.
    vec3 entry;
    vec3 step_vector;
    // The same in voxels from the first voxel's centre, beyond the digits of one f32: the entry as whole voxels and
    // what is left, the step as a sum of three, of which the first two have few enough bits to be multiplied exactly.
    vec3 whole;
    vec3 part;
    vec3 stride_high;
    vec3 stride_middle;
    vec3 stride_rest;
    // Length inside the volume, in steps.
    float steps;
    // Samples on the ray; of a part of a ray one past its last.
    uint samples;
#ifdef REFRACTION
    // Where the ray has bent last, in steps from the entry point: `entry`, `whole` and `part` are of that place. Whether it has. The
    // index of refraction along its direction.
    float anchor;
    bool bent;
    vec3 momentum;
#endif
#ifdef LAYERS
    // The part of the ray that is drawn, in steps; samples on the whole ray.
    float begin;
    float end;
    uint all;
#endif
#if defined(LAYERS) || defined(SLICES)
    // The first sample of the part of the ray that is drawn.
    uint first;
#endif
#ifdef SLICES
    // Steps from slice to slice; the pixel of the ray; of a ray on a slice the number of that, and its depth in front of the eye.
    float stride;
    vec2 pixel;
    float slice;
    float depth;
#endif
};

// The last sample stands for what is left of the ray only; one that a surface cuts, for what is left of its step.
layout(constant_id = 5) const bool LAST_PARTIAL = false;
// A step that would leave the volume has no sample [Stegmaier05 §5].
layout(constant_id = 27) const bool LAST_NONE = false;

#ifdef LAYER_BEFORE
// Whether a ray has a part behind a layer that is drawn.
bool goes_on(vec4 before) {
#ifdef CLIPPED
    return before.x > 0.0 && before.w >= 0.0;
#else
    return before.x > 0.0;
#endif
}
#endif

#if defined(LAYERS) && !defined(SLICES)
// Cuts a ray at the layers before and behind: its samples are those of the whole ray that lie between or, where they stand
// for parts of steps, whose steps do so in part.
void cut(inout Ray ray) {
    ray.all = ray.samples;
    ray.begin = 0.0;
    ray.end = ray.steps;
    vec4 behind = layer_behind();
    if (behind.x > 0.0) {
        ray.end = min(behind.z * frame.inverse_step, ray.steps);
    }
#ifdef LAYER_BEFORE
    vec4 before = layer_before();
    ray.begin = goes_on(before) ? max(before.z * frame.inverse_step, 0.0) : ray.steps;
#endif
    ray.first = 0u;
    ray.samples = 0u;
    if (ray.begin < ray.end && ray.all > 0u) {
        vec2 between = vec2(ray.begin, ray.end);
        if (LAST_PARTIAL) {
            ray.first = min(uint(between.x), ray.all - 1u);
            ray.samples = min(uint(ceil(between.y)), ray.all);
        } else {
            uvec2 samples = uvec2(max(ceil(between - frame.offset), 0.0));
            ray.first = samples.x;
            ray.samples = min(samples.y, ray.all);
            if (ray.first >= ray.samples) {
                // Between two surfaces, and no sample there.
                ray.first = 0u;
                ray.samples = 0u;
            }
        }
    }
}
#endif

#ifdef SLICES
#include "shared/slices.glsl"

// How much wider than slices reach the volume is for those who decide about them, and how many more of a spacing: no slice that is drawn
// is taken for one beyond the ray, whatever rounding does.
const float WIDER = 2.0 * SLICE_SLACK;
const float MORE = 1e-3;

// The ray of this pixel, by the slices it may meet.
Ray load_ray() {
    vec2 pixel = vec2(this_pixel()) + 0.5 + vec2(frame.first_column, frame.first_row);
    Ray ray = ray_on_slice(pixel, 0.0, false);
    vec3 origin = slice_origin(pixel);
    vec3 way = slice_way(pixel);
    vec2 between = slice_interval(origin, way, WIDER);
#ifdef LAYERS
    between = slice_part(between);
#endif
    uvec2 met = slices_between(origin, way, between, MORE);
    ray.first = met.x;
    ray.samples = met.y;
    return ray;
}
#else
// Sets how far a ray along a unit vector of volume space comes in a step.
void stride_along(inout Ray ray, vec3 unit) {
    for (int axis = 0; axis < 3; ++axis) {
        vec2 stride = df_multiply(vec2(unit[axis], 0.0), vec2(frame.voxel_step[0][axis], frame.voxel_step[1][axis]));
        ray.stride_high[axis] = leading(stride.x, STRIDE_CLEARED);
        ray.stride_middle[axis] = leading(stride.x - ray.stride_high[axis], STRIDE_CLEARED);
        ray.stride_rest[axis] = ((stride.x - ray.stride_high[axis]) - ray.stride_middle[axis]) + stride.y;
        ray.step_vector[axis] = stride.x / frame.dims[axis];
    }
}

// Samples on a ray that is so many steps long.
uint samples_on(float steps) {
    return LAST_NONE ? uint(steps) : uint(max(ceil(steps - frame.offset), 0.0));
}

// A ray from the entry point (texture coordinates) along `unit`, a unit vector in volume space with the ray's length in w.
Ray ray_along(vec3 begin, vec4 unit) {
    Ray ray;
    ray.direction = unit.xyz;
    ray.entry = begin;
    stride_along(ray, unit.xyz);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 first = df_add(two_product(ray.entry[axis], frame.dims[axis]), vec2(-0.5, 0.0));
        ray.whole[axis] = floor(first.x);
        ray.part[axis] = (first.x - ray.whole[axis]) + first.y;
    }
    ray.steps = unit.w * frame.inverse_step;
    ray.samples = samples_on(ray.steps);
#ifdef REFRACTION
    ray.anchor = 0.0;
    ray.bent = false;
    ray.momentum = unit.xyz;
#endif
#ifdef LAYERS
    cut(ray);
#endif
    return ray;
}

// The ray of this pixel, from what the first two passes stored [KW03 §2.1], or as they find it.
Ray load_ray() {
#ifdef OWN_RAYS
    vec2 pixel = vec2(this_pixel()) + 0.5 + vec2(frame.first_column, frame.first_row);
    ViewRay view = view_ray(pixel);
    Interval interval = box_interval(pixel, view);
    vec3 begin = entry_at(view, interval);
    return ray_along(begin, direction_from(view, interval, begin));
#else
    ivec2 pixel = this_pixel();
    return ray_along(texelFetch(entry, pixel, 0).xyz, texelFetch(direction, pixel, 0));
#endif
}
#endif

// The first sample of the part of the ray that is drawn.
uint first_sample(Ray ray) {
#if defined(LAYERS) || defined(SLICES)
    return ray.first;
#else
    return 0u;
#endif
}

// The first sample of the segment for main pass `pass`.
uint segment_begin(Ray ray, uint pass) {
#ifdef BEGINS_LATE
    return max(pass * SAMPLES_PER_PASS, ray.first);
#else
    return pass * SAMPLES_PER_PASS;
#endif
}

// One past the last sample of the segment that begins with sample `i`, where the ray has as many.
uint segment_end(uint i) {
#ifdef BEGINS_LATE
    return (i / SAMPLES_PER_PASS + 1u) * SAMPLES_PER_PASS;
#else
    return i + SAMPLES_PER_PASS;
#endif
}

// Whether the part of the ray that is drawn begins behind the segment for main pass `pass`.
bool begins_later(Ray ray, uint pass) {
#ifdef BEGINS_LATE
    return (pass + 1u) * SAMPLES_PER_PASS <= ray.first && ray.first < ray.samples;
#else
    return false;
#endif
}

#ifdef PARTIAL_APART
// Depth of a ray of which nothing is left but the segment that ends at a surface: below that of a dead one, above all others, and
// another in each part of the ray (partial_depth in src/twin/section.rs).
layout(constant_id = 17) const float PARTIAL_DEPTH = 0.75;

// Whether the part of the ray that is drawn ends at a surface, and main pass `pass` is the one of its last segment or behind.
bool only_partial(Ray ray, uint pass) {
#if defined(LAYERS) && !defined(SLICES)
    return ray.end < ray.steps && ray.samples > 0u && (ray.samples - 1u) / SAMPLES_PER_PASS <= pass;
#else
    return false;
#endif
}
#endif

// Steps from the entry point to sample `i`: from the index, never from adding steps up. A ray on a slice begins there.
float steps_to(uint i) {
#ifdef SLICES
    return 0.0;
#else
    return float(i) + frame.offset;
#endif
}

// Steps from sample to sample.
float stride_of(Ray ray) {
#ifdef SLICES
    return ray.stride;
#else
    return 1.0;
#endif
}

// Steps from where the ray has bent last, of a place so many steps from the entry point.
float from_anchor(Ray ray, float steps) {
#ifdef REFRACTION
    return steps - ray.anchor;
#else
    return steps;
#endif
}

// Texture coordinates `steps` from the entry point, rounded to some 2^-24 of the volume.
vec3 position_at(Ray ray, float steps) {
    return fma(vec3(from_anchor(ray, steps)), ray.step_vector, ray.entry);
}

// A point by the voxel below it on each axis and its distance from there, in voxels from voxel centre to voxel centre.
struct Place {
    vec3 below;
    vec3 weight;
};

// The place `distance` steps from the entry point, for a sample to some 2^-22 voxels, wherever in the volume: whole voxels are
// kept apart, so that the weights keep their digits.
Place place_at(Ray ray, float distance) {
    vec3 steps = vec3(from_anchor(ray, distance));
    vec3 way = steps * ray.stride_high;
    vec3 way_whole = floor(way);
    vec3 rest = steps * ray.stride_middle + steps * ray.stride_rest;
    // In this order: the first difference is exact.
    precise vec3 left = ((way - way_whole) + ray.part) + rest;
    vec3 carry = floor(left);
    return Place(ray.whole + way_whole + carry, left - carry);
}

// The place of sample `i` of the ray of a pixel.
Place place_of(Ray ray, uint i) {
#ifdef SLICES
    return place_at(ray_on_slice(ray.pixel, float(i), true), 0.0);
#else
    return place_at(ray, steps_to(i));
#endif
}

// The cell (2x2x2 voxels) a point lies in; border cells reach to the faces. Twin: src/scene/field.rs.
ivec3 cell_of(Place place) {
    ivec3 last = max(ivec3(frame.dims.xyz) - 2, ivec3(0));
    return clamp(ivec3(place.below), ivec3(0), last);
}

// More steps than a ray has.
const float UNBOUNDED = 1e9;

// Steps from a place until the ray leaves the box of `side`^3 cells it lies in; UNBOUNDED where it leaves the volume
// with it.
float steps_inside(Ray ray, Place place, ivec3 box, int side) {
    ivec3 last = max(ivec3(frame.dims.xyz) - 2, ivec3(0)) / side;
    vec3 stride = ray.step_vector * frame.dims.xyz;
    bvec3 up = greaterThan(stride, vec3(0.0));
    // Box b covers the cells from side b on, from voxel centre to voxel centre.
    vec3 face = float(side) * vec3(box + ivec3(up));
    vec3 steps = ((face - place.below) - place.weight) / stride;
    steps = mix(steps, vec3(UNBOUNDED), equal(box, mix(ivec3(0), last, up)));
    steps = mix(steps, vec3(UNBOUNDED), equal(stride, vec3(0.0)));
    return max(min(steps.x, min(steps.y, steps.z)), 0.0);
}
