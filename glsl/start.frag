// What rays begin with, in every pixel the box covers: front faces of the box. A ray whose samples are all skipped has this
// for its picture. SHORT_RAYS: a ray so short that it takes no sample holds what no sample can change, instead of the
// greatest value of the volume. BLACK: nothing is emitted where a ray meets no shell.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [SHORT_RAYS | BLACK], [SLICES], [PLANES], [ORTHOGRAPHIC]

#ifndef BLACK
#include "shared/frame.glsl"
#include "shared/opacity.glsl"
#include "shared/projection.glsl"
#endif
#ifdef SHORT_RAYS
#include "shared/double_float.glsl"
#ifdef SLICES
#include "shared/ray.glsl"
#endif
#include "shared/pixel.glsl"
#include "shared/layer.glsl"
#include "shared/samples.glsl"
#endif

layout(location = 0) out vec4 accumulated;

void main() {
#ifdef BLACK
    accumulated = vec4(vec3(0.0), 1.0);
#else
    accumulated = vec4(no_sample().rgb, 1.0);
#endif
#ifdef SHORT_RAYS
#ifdef SLICES
    bool takes_none = slices_met(gl_FragCoord.xy + vec2(frame.first_column, frame.first_row)) == 0u;
#else
    bool takes_none = load_ray().samples == 0u;
#endif
    if (takes_none) {
        accumulated = vec4(vec3(x_of(frame.end)), 1.0);
    }
#endif
}
