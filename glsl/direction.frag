// Pass 2, ray direction determination [KW03 §2.1, Thesis §5.2.2]: back faces of the box, normalize(exit - entry)
// in colour and the length in alpha, both in volume space.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"

layout(set = 0, binding = 1) uniform sampler2D entry;

layout(location = 0) out vec4 direction;

void main() {
    vec2 pixel = gl_FragCoord.xy;
    Interval interval = box_interval(pixel);
    vec3 begin = texelFetch(entry, ivec2(pixel), 0).xyz;
    vec3 way;
    for (int axis = 0; axis < 3; ++axis) {
        vec2 end = texture_coordinate(pixel, interval.leave, axis, interval.leave_axis, true);
        vec2 difference = df_add(end, vec2(-begin[axis], 0.0));
        vec2 scaled = df_multiply(difference, vec2(frame.extent[0][axis], frame.extent[1][axis]));
        way[axis] = scaled.x + scaled.y;
    }
    float size = length(way);
    bool hits = df_less(interval.enter, interval.leave) && size > 0.0;
    direction = hits ? vec4(way / size, size) : vec4(0.0);
}
