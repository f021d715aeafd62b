// What becomes of light on its way to a place of a surface [Stegmaier05 §6]. SHADOWS: surfaces take from it where it crosses them.
// TRANSLUCENT: it comes through what the outermost surface encloses, the weaker the longer its way in there is. Twin:
// src/twin/light_path.rs. Needs frame.glsl, samples.glsl, volume.glsl, surface.glsl and way_out.glsl.
//
// Samples lie a step apart along the way from the surface to the light. Between two of them light crosses a surface where the values
// are on its two sides, at the place that a value which goes evenly has.

#ifdef SHADOWS
// How far in front of its surface a way to a light begins, in volume units: it would meet the surface itself where rounding, and the
// way in which the place was found, put that a little within.
layout(constant_id = 28) const float SHADOW_BIAS = 0.0;
#endif
#ifdef TRANSLUCENT
// What a volume unit within the surface takes of light: it leaves exp(-ABSORPTION).
layout(constant_id = 29) const float ABSORPTION = 0.0;
// The part of a surface's colour that is light which comes through.
layout(constant_id = 30) const float THROUGH = 0.0;
#endif

// The value at a point of volume space.
float value_at_point(vec3 point) {
    vec3 voxel = fma(point, frame.inverse_extent[0].xyz, vec3(0.5)) * frame.dims.xyz - 0.5;
    vec3 below = floor(voxel);
    return value_at(Place(below, voxel - below));
}

#ifdef SHADOWS
// What surfaces leave of light that comes to a place from a light at a distance `reach` along a unit vector; `normal` points to where
// the light is.
float clear_to_light(vec3 point, vec3 normal, vec3 way, float reach) {
    vec3 begin = fma(vec3(SHADOW_BIAS), normal, point);
    float length = way_out(begin, way, reach);
    float clear = 1.0;
    int within = surfaces_around(value_at_point(begin));
    float at = 0.0;
    for (float steps = 1.0; clear > 0.0 && at < length; ++steps) {
        at = min(steps / frame.inverse_step, length);
        int to = surfaces_around(value_at_point(fma(vec3(at), way, begin)));
        while (within != to) {
            clear *= 1.0 - surface_levels.list[to > within ? within : within - 1].color.a;
            within += to > within ? 1 : -1;
            // Asked at the end as well: segment.glsl.
            if (within == to) {
                break;
            }
        }
    }
    return clear;
}
#endif

#ifdef TRANSLUCENT
// What comes through of light from there.
float through_to_light(vec3 point, vec3 way, float reach) {
    float length = way_out(point, way, reach);
    float level = surface_levels.list[0].from;
    float inside = 0.0;
    float front = value_at_point(point) - level;
    float at = 0.0;
    for (float steps = 1.0; at < length; ++steps) {
        float to = min(steps / frame.inverse_step, length);
        float back = value_at_point(fma(vec3(to), way, point)) - level;
        float part = front >= 0.0 ? (back >= 0.0 ? 1.0 : front / (front - back)) : (back >= 0.0 ? back / (back - front) : 0.0);
        inside = fma(to - at, part, inside);
        front = back;
        at = to;
    }
    return exp(-ABSORPTION * inside);
}
#endif
