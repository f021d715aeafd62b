// What surfaces reflect: a picture of all that is around the volume, of which only the direction matters [Thesis §4.3]. Twin:
// src/twin/environment.rs, with the formula in src/scene/environment.rs.

// Linear red, green and blue.
layout(set = 0, binding = 21) uniform sampler2D environment;

// Three rows that lead from the volume's own axes to volume space, and in the first number of the fourth the part of a colour that is
// reflected.
layout(set = 0, binding = 22, std430) readonly buffer EnvironmentPlace {
    vec4 rows[4];
} environment_place;

// Which direction each place of the picture shows (`Mapping` in src/scene/settings/environment.rs).
const int LATLONG = 0;
const int SPHERE = 1;
layout(constant_id = 22) const int MAPPING = LATLONG;

const float PI = 3.14159265;
const float TAN_PI_8 = 0.41421356;

// The angle of a point from the x axis, from -pi to pi, to some units in the last place, of which devices may take thousands from
// `atan`; 0 in the origin. The polynomial is that of `atanf` in Cephes.
float angle_of(float y, float x) {
    float least = min(abs(x), abs(y));
    float most = max(abs(x), abs(y));
    if (most == 0.0) {
        return 0.0;
    }
    float slope = least / most;
    bool steep = slope > TAN_PI_8;
    float t = steep ? (slope - 1.0) / (slope + 1.0) : slope;
    float s = t * t;
    float higher = ((8.05374449538e-2 * s - 1.38776856032e-1) * s + 1.99777106478e-1) * s - 3.33329491539e-1;
    float angle = fma(higher * s, t, t) + (steep ? 0.25 * PI : 0.0);
    angle = abs(y) > abs(x) ? 0.5 * PI - angle : angle;
    angle = x < 0.0 ? PI - angle : angle;
    return y < 0.0 ? -angle : angle;
}

// A texel; beside the picture that on its edge, of latlong ones across that on the other side.
vec3 environment_texel(ivec2 at) {
    ivec2 size = textureSize(environment, 0);
    ivec2 held = clamp(at, ivec2(0), size - 1);
    held.x = MAPPING == LATLONG ? (at.x + size.x) % size.x : held.x;
    return texelFetch(environment, held, 0).rgb;
}

// What is seen in a direction of volume space, of length 1, between the four texels around its place.
vec3 environment_color(vec3 way) {
    vec2 at = vec2(0.5, 0.0);
    if (MAPPING == LATLONG) {
        at = vec2(0.5 + angle_of(way.x, -way.z) / (2.0 * PI), angle_of(length(way.xz), way.y) / PI);
    } else {
        float m = 2.0 * length(way + vec3(0.0, 0.0, 1.0));
        at = m > 0.0 ? vec2(0.5 + way.x / m, 0.5 - way.y / m) : at;
    }
    vec2 place = at * vec2(textureSize(environment, 0)) - 0.5;
    ivec2 low = ivec2(floor(place));
    vec2 weight = place - floor(place);
    vec3 above = mix(environment_texel(low), environment_texel(low + ivec2(1, 0)), weight.x);
    vec3 below = mix(environment_texel(low + ivec2(0, 1)), environment_texel(low + ivec2(1, 1)), weight.x);
    return mix(above, below, weight.y);
}

// A surface of that colour in all lights, with what it reflects; without a gradient it reflects nothing.
vec3 reflecting(vec3 color, vec3 gradient, vec3 view) {
    float steepest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    if (steepest == 0.0) {
        return color;
    }
    vec3 way = reflect(-view, normalize(gradient / steepest));
    vec3 turned = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        turned[axis] = dot(environment_place.rows[axis].xyz, way);
    }
    return mix(color, environment_color(turned), environment_place.rows[3].x);
}
