// Fronts less backs of each clip mesh that a ray meets beyond the near plane, added up by the blend unit. What a ray enters less
// often than it leaves it, it begins in.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [ORTHOGRAPHIC]

#include "shared/frame.glsl"
#include "shared/double_float.glsl"
#include "shared/ray.glsl"
#include "shared/polygon.glsl"

layout(location = 0) flat in uint triangle;

layout(location = 0) out vec4 winding;

void main() {
    Meeting found = meet(triangle, gl_FragCoord.xy + vec2(frame.first_column, frame.first_row));
    if (!found.shown) {
        discard;
    }
    winding = vec4(0.0);
    winding[found.material.clip - 1u] = found.front ? 1.0 : -1.0;
}
