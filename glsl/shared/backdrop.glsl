// A plane behind the volume, across the view [Stegmaier05 §4]: the same code for rays that leave the volume and for pixels beside it, so
// that there is no seam between the two. Twin: src/twin/backdrop.rs, with the formulas in src/scene/backdrop.rs. Needs frame.glsl.
// BACKDROP_PICTURE: a picture is on it, else a checker.

// How far the plane is behind the corner of the volume that is farthest from the eye, in volume units.
layout(constant_id = 34) const float BEHIND = 0.0;
// Pixels of the view.
layout(constant_id = 35) const float VIEW_WIDTH = 1.0;
layout(constant_id = 36) const float VIEW_HEIGHT = 1.0;

#ifdef BACKDROP_PICTURE
// Linear red, green and blue.
layout(set = 0, binding = 25) uniform sampler2D backdrop;

// Pixels of the view in a texel.
layout(constant_id = 37) const float PIXELS_IN_TEXEL = 1.0;

// A texel; beside the picture it goes on mirrored.
vec3 backdrop_texel(vec2 at) {
    vec2 size = vec2(textureSize(backdrop, 0));
    vec2 turn = at - 2.0 * size * floor(at / (2.0 * size));
    vec2 there = mix(2.0 * size - 1.0 - turn, turn, lessThan(turn, size));
    return texelFetch(backdrop, ivec2(clamp(there, vec2(0.0), size - 1.0)), 0).rgb;
}
#else
// Squares in the height of the view, and their greys (GREYS in src/scene/backdrop.rs).
layout(constant_id = 38) const float SQUARES = 1.0;
const float GREYS[2] = float[](0.8, 0.2);
#endif

// Places beyond this, in pixels, are too far away to be told apart (FARTHEST in src/scene/backdrop.rs).
const float FARTHEST = 1e6;

// What shows in a place of the view, column and row in pixels.
vec3 backdrop_color(vec2 place) {
#ifdef BACKDROP_PICTURE
    vec2 middle = 0.5 * vec2(VIEW_WIDTH, VIEW_HEIGHT);
    vec2 at = (place - middle) / PIXELS_IN_TEXEL + 0.5 * vec2(textureSize(backdrop, 0)) - 0.5;
    vec2 low = floor(at);
    vec2 weight = at - low;
    vec3 above = mix(backdrop_texel(low), backdrop_texel(low + vec2(1.0, 0.0)), weight.x);
    vec3 below = mix(backdrop_texel(low + vec2(0.0, 1.0)), backdrop_texel(low + vec2(1.0, 1.0)), weight.x);
    return mix(above, below, weight.y);
#else
    vec2 square = floor(place * SQUARES / VIEW_HEIGHT);
    float odd = square.x + square.y - 2.0 * floor(0.5 * (square.x + square.y));
    return vec3(GREYS[int(odd)]);
#endif
}

// What a pixel shows whose ray goes straight.
vec3 backdrop_straight(ivec2 pixel) {
    return backdrop_color(vec2(pixel) + 0.5 + vec2(frame.first_column, frame.first_row));
}

// What is met from a point along a vector, both of volume space; black where that never comes to the plane.
vec3 backdrop_met(vec3 point, vec3 way) {
    vec3 origin = frame.origin[0].xyz;
    vec3 base = frame.base[0].xyz;
    vec3 right = frame.right[0].xyz;
    vec3 down = frame.down[0].xyz;
    // Products of vectors that are a pixel long, or less than one, may leave the range of f32.
    float across = length(right);
    float along = length(down);
    vec3 forward = normalize(cross(right / across, down / along));
    forward = dot(forward, base) < 0.0 ? -forward : forward;
    float depth = dot(0.5 * frame.extent[0].xyz, abs(forward)) - dot(origin, forward) + BEHIND;
    float rise = dot(way, forward);
    if (rise <= 0.0) {
        return vec3(0.0);
    }
    vec3 on = point + (depth - dot(point - origin, forward)) / rise * way;
#ifdef ORTHOGRAPHIC
    vec3 arm = on - origin;
#else
    vec3 arm = (on - origin) / depth - base;
#endif
    vec2 place = vec2(dot(arm, right / across) / across, dot(arm, down / along) / along);
    return all(lessThanEqual(abs(place), vec2(FARTHEST))) ? backdrop_color(place) : vec3(0.0);
}
