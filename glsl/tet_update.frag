// Update of depths after every second propagation step [Weiler03 "Terminating Finished Rays"]: a ray without a current cell is finished,
// and one that needs no more. Runs for every fragment, since it writes depth.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY
//@takes [ENDLESS]

#include "shared/frame.glsl"
#include "shared/mark.glsl"
#include "shared/opacity.glsl"
#ifndef ENDLESS
#define READS_GATHERED
#endif
#include "shared/projection.glsl"

layout(set = 0, binding = 67) uniform sampler2D tet_cell;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    bool gone = texelFetch(tet_cell, texel, 0).x == 0.0;
#ifdef ENDLESS
    bool saturated = false;
#else
    bool saturated = ended(texelFetch(GATHERED, texel, 0), 0.0);
#endif
    MARK(gone || saturated ? DEAD : 0.0);
}
