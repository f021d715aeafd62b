// Puts rays behind a layer of faces into the first set of traversal data [Weiler03 "Traversal Data"].
//
// VALUES: RES begins with what a ray holds before its first cell. GOES_ON: where that has not been before.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [VALUES], [GOES_ON], [STORAGE]

#include "shared/frame.glsl"
#include "shared/opacity.glsl"
#ifdef VALUES
#include "shared/projection.glsl"
#endif

// As in boundary.glsl.
#include "shared/rows.glsl"

ROWS(64, TetBoundary, usamplerBuffer, uvec4, tet_boundary);

layout(set = 0, binding = 66) uniform sampler2D tet_entry;

#if defined(VALUES) && defined(GOES_ON)
layout(input_attachment_index = 0, set = 0, binding = 7) uniform subpassInput accumulated;
#endif

layout(location = 0) out vec2 cell;
layout(location = 1) out vec2 point;
#ifdef VALUES
layout(location = 2) out vec4 gathered;
#endif

void main() {
    vec4 entered = texelFetch(tet_entry, ivec2(gl_FragCoord.xy), 0);
    uint side = entered.y > 0.0 ? ROW(tet_boundary, 2u * (uint(entered.y) - 1u)).x : 0u;
    cell = side > 0u ? vec2(float((side - 1u) >> 2) + 1.0, float((side - 1u) & 3u)) : vec2(0.0);
    point = entered.zw;
#ifdef VALUES
#ifdef GOES_ON
    vec4 held = subpassLoad(accumulated);
#else
    vec4 held = vec4(0.0);
#endif
    gathered = held.a == 0.0 && entered.y > 0.0 ? vec4(no_sample().rgb, 1.0) : held;
#endif
}
