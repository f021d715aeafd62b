// Pass 2, ray direction determination [KW03 §2.1, Thesis §5.2.2]: back faces of the box, normalize(exit - entry)
// in colour and the length in alpha, both in volume space. Each is the f32 nearest to the true number: samples far
// along the ray magnify an error made here.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [PLANES]

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"

layout(set = 0, binding = 1) uniform sampler2D entry;

layout(location = 0) out vec4 direction;

void main() {
    vec2 pixel = gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
    Interval interval = box_interval(pixel);
    vec3 begin = texelFetch(entry, ivec2(gl_FragCoord.xy), 0).xyz;
    vec2 way[3];
    vec2 square = vec2(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        vec2 end = texture_coordinate(pixel, interval.leave, axis, interval.leave_axis, true);
        vec2 difference = df_add(end, vec2(-begin[axis], 0.0));
        way[axis] = df_multiply(difference, vec2(frame.extent[0][axis], frame.extent[1][axis]));
        square = df_add(square, df_multiply(way[axis], way[axis]));
    }
    bool hits = df_less(interval.enter, interval.leave) && square.x > 0.0;
    direction = vec4(0.0);
    if (hits) {
        vec2 size = df_sqrt(square);
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = df_divide(way[axis], size).x;
        }
        direction.w = size.x;
    }
}
