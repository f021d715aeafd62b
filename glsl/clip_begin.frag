// Where rays begin, within which clip meshes: a layer in front of all others, at which no surface is.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/clip.glsl"

layout(set = 0, binding = 15) uniform sampler2D clip_winding;

layout(location = 0) out vec4 surface;

// Near over depth of the near plane, in front of which nothing is drawn.
const float NEAREST = 1.0;

void main() {
    vec4 entered = texelFetch(clip_winding, ivec2(gl_FragCoord.xy), 0);
    surface = vec4(NEAREST, 0.0, 0.0, clip_state_at_begin(entered));
}
