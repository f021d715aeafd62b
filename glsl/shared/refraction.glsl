// Rays that bend wherever the index of refraction changes [Stegmaier05 §6]. Twin: src/twin/refraction.rs. Needs frame.glsl, samples.glsl,
// volume.glsl, gradient.glsl and way_out.glsl.
//
// A ray goes along T, whose length is the index n, and T changes by the gradient of n along the way: Hamilton's equations of |T| - n.
// Between two samples it goes straight; at each sample T takes what the step around it changes. This is the leapfrog method, of
// second order in the step; it keeps what a smooth plane keeps, the part of T along the plane, to rounding. Where the index
// does not change nothing happens, so that there a ray is the straight one to the bit.

// Of each piece of the index (begin in units of the volume texture, index there, what it rises by in such a unit, 0).
layout(set = 0, binding = 24, std430) readonly buffer RefractiveIndex {
    vec4 pieces[];
} refractive_index;

// Pieces of the index, and the first power of two that is not below their number, halved: where the search begins.
layout(constant_id = 31) const int INDEX_PIECES = 1;
layout(constant_id = 32) const int INDEX_SEARCH = 0;
// The longest way of a ray that bends, in steps.
layout(constant_id = 33) const float LONGEST_WAY = 0.0;

// The piece of a value; at a point that behind it.
vec4 index_piece(float value) {
    int at = 0;
    for (int width = INDEX_SEARCH; width > 0; width >>= 1) {
        if (at + width < INDEX_PIECES && value >= refractive_index.pieces[at + width].x) {
            at += width;
        }
    }
    return refractive_index.pieces[at];
}

// What a ray has where it enters the volume.
void begin_bending(inout Ray ray) {
    float value = sample_volume(ray, 0.0);
    vec4 piece = index_piece(value);
    ray.momentum = fma(value - piece.x, piece.z, piece.y) * ray.direction;
}

// Lets the ray go on from a place, so many steps from the entry point, along a unit vector of volume space until it leaves the volume.
void turn_at(inout Ray ray, Place place, float steps, vec3 unit) {
    ray.direction = unit;
    ray.anchor = steps;
    ray.bent = true;
    ray.whole = place.below;
    ray.part = place.weight;
    ray.entry = (place.below + place.weight + 0.5) / frame.dims.xyz;
    stride_along(ray, unit);
    vec3 point = (ray.entry - 0.5) * frame.extent[0].xyz;
    float left = max(way_out(point, unit, UNBOUNDED), 0.0);
    ray.steps = min(fma(left, frame.inverse_step, steps), max(steps, LONGEST_WAY));
    ray.samples = samples_on(ray.steps);
}

// Bends the ray at sample `i`, by what the index changes around it.
void bend(inout Ray ray, uint i) {
    if (in_hole(ray, i)) {
        return;
    }
    float steps = steps_to(i);
    float slope = index_piece(sample_volume(ray, steps)).z;
    if (slope == 0.0) {
        return;
    }
    Place place = place_at(ray, steps);
    // A sample stands for half a step to each side, as far as the ray is in the volume.
    float around = min(steps + 0.5, ray.steps) - max(steps - 0.5, 0.0);
    vec3 momentum = fma(vec3(around * frame.step_voxels * slope), gradient_at(place), ray.momentum);
    float size = length(momentum);
    if (momentum == ray.momentum || size == 0.0) {
        return;
    }
    ray.momentum = momentum;
    turn_at(ray, place, steps, momentum / size);
}
