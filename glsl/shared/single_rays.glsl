// Rays of the view and where they meet the volume's box, in single floats: ray.glsl where those are good enough. Twin:
// src/math/ray.rs; src/scene/single_rays.rs makes the numbers and bounds the error. `precise` lets all shaders find the same rays.
// Needs frame.glsl.

#ifndef COMPUTE
#define FROM_VERTICES
#endif
#include "shared/view_rays.glsl"
#ifdef COMPUTE
SingleRays view_rays = single_rays.of_view;
#endif

// A ray through a place of the picture: its place in two parts, and its heading.
struct ViewRay {
    vec3 place;
    vec3 place_low;
    vec3 heading;
};

// Depths between which the ray is inside the box and beyond the near plane. A ray that misses has enter >= leave.
struct Interval {
    float enter;
    float leave;
};

// Headings below this count as this: a quotient by them is a number, beyond every volume.
const float SLOWEST = 1e-30;

ViewRay view_ray(vec2 pixel) {
    vec2 at = pixel - view_rays.center;
    // Exact.
    precise vec3 place = view_rays.place[0].xyz + at.x * view_rays.place_right[0].xyz + at.y * view_rays.place_down[0].xyz;
    precise vec3 place_low = view_rays.place[1].xyz + at.x * view_rays.place_right[1].xyz + at.y * view_rays.place_down[1].xyz;
    precise vec3 high = view_rays.heading[0].xyz + at.x * view_rays.heading_right[0].xyz + at.y * view_rays.heading_down[0].xyz;
    precise vec3 low = view_rays.heading[1].xyz + at.x * view_rays.heading_right[1].xyz + at.y * view_rays.heading_down[1].xyz;
    precise vec3 heading = high + low;
    return ViewRay(place, place_low, heading);
}

// The interval of a ray. Nothing of it follows from the pixel; ray.glsl, whose function this stands for, cuts it at planes there.
Interval box_interval(vec2 pixel, ViewRay ray) {
    // As if the ray went up on every axis: where it goes down, all is seen from the other side.
    uvec3 down = floatBitsToUint(ray.heading) & 0x80000000u;
    vec3 place = uintBitsToFloat(floatBitsToUint(ray.place) ^ down);
    vec3 place_low = uintBitsToFloat(floatBitsToUint(ray.place_low) ^ down);
    vec3 speed = max(abs(ray.heading), SLOWEST);
    precise vec3 first = ((-0.5 - place) - place_low) / speed;
    precise vec3 second = ((0.5 - place) - place_low) / speed;
    return Interval(max(max(first.x, first.y), max(first.z, view_rays.near)), min(min(second.x, second.y), second.z));
}

// The place of a ray at a depth, texture coordinates from the middle.
vec3 place_in_box(ViewRay ray, float depth) {
    precise vec3 place = (ray.place + ray.place_low) + depth * ray.heading;
    return place;
}

// Where the ray enters, texture coordinates.
vec3 entry_at(ViewRay ray, Interval interval) {
    precise vec3 entry = place_in_box(ray, interval.enter) + 0.5;
    return clamp(entry, 0.0, 1.0);
}

// normalize(exit - entry) and the length, both in volume space, of a ray that enters at `begin`; 0 where it misses.
vec4 direction_from(ViewRay ray, Interval interval, vec3 begin) {
    precise vec3 way = (place_in_box(ray, interval.leave) - (begin - 0.5)) * frame.extent[0].xyz;
    precise float square = way.x * way.x + way.y * way.y + way.z * way.z;
    precise float size = sqrt(square);
    precise vec3 direction = way / size;
    return interval.enter < interval.leave && size > 0.0 ? vec4(direction, size) : vec4(0.0);
}
