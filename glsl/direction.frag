// Pass 2, ray direction determination [KW03 §2.1, Thesis §5.2.2]: back faces of the box, normalize(exit - entry)
// in colour and the length in alpha, both in volume space.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [PLANES | SINGLE_RAYS], [ORTHOGRAPHIC]

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"

layout(set = 0, binding = 1) uniform sampler2D entry;

layout(location = 0) out vec4 direction;

void main() {
    vec2 pixel = gl_FragCoord.xy + vec2(frame.first_column, frame.first_row);
    vec3 begin = texelFetch(entry, ivec2(gl_FragCoord.xy), 0).xyz;
    ViewRay ray = view_ray(pixel);
    direction = direction_from(ray, box_interval(pixel, ray), begin);
}
