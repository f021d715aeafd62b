// Update of depths after every second propagation step [Weiler03 "Terminating Finished Rays"]: a ray without a current cell is finished,
// and one that needs no more. Runs for every fragment, since it writes depth.
//
// BESIDE: a colour is attached and written for nothing, into the set that the next step writes anew. Mesa 26's lavapipe forgets that
// attachments blend each in its own way once a step without colour attachments was drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY
//@takes [ENDLESS], [BESIDE]

#include "shared/frame.glsl"
#include "shared/mark.glsl"
#include "shared/opacity.glsl"
#ifndef ENDLESS
#define READS_GATHERED
#endif
#include "shared/projection.glsl"

layout(set = 0, binding = 67) uniform sampler2D tet_cell;

#ifdef BESIDE
layout(location = 0) out vec2 beside;
#endif

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    bool gone = texelFetch(tet_cell, texel, 0).x == 0.0;
#ifdef ENDLESS
    bool saturated = false;
#else
    bool saturated = ended(texelFetch(GATHERED, texel, 0), 0.0);
#endif
#ifdef BESIDE
    beside = vec2(0.0);
#endif
    MARK(gone || saturated ? DEAD : 0.0);
}
