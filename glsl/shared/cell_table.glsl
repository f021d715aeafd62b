// Ways through cells by a table over the values at their ends and their length [Röttger, Kraus and Ertl 2000, Weiler03 "Ray Integration"].
// Twin: src/truth/cell_table.rs. Needs seen.glsl.
//
// Departure: the shader interpolates in f32, where texture units have weights of a few bits.

// Premultiplied colour and opacity.
layout(set = 0, binding = 69) uniform sampler3D tet_table;

vec4 between_fronts(ivec3 low, float weight) {
    return mix(texelFetch(tet_table, low, 0), texelFetch(tet_table, low + ivec3(1, 0, 0), 0), weight);
}

vec4 between_values(ivec3 low, vec2 weight) {
    return mix(between_fronts(low, weight.x), between_fronts(low + ivec3(0, 1, 0), weight.x), weight.y);
}

// Premultiplied colour and opacity of a way of so many reference lengths on which x goes evenly from `front` to `back`.
vec4 cell_integral(float front, float back, float lengths) {
    vec4 axes = tet_view.table;
    vec3 place = vec3((vec2(front, back) - axes.x) * axes.y, lengths * axes.z);
    vec3 last = vec3(textureSize(tet_table, 0) - 1);
    place = clamp(place, vec3(0.0), last);
    vec3 low = min(floor(place), last - 1.0);
    vec3 weight = place - low;
    ivec3 at = ivec3(low);
    return mix(between_values(at, weight.xy), between_values(at + ivec3(0, 0, 1), weight.xy), weight.z);
}
