// What rays begin with, in every pixel the box covers: front faces of the box. A ray whose samples are all skipped has this
// for its picture.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shared/frame.glsl"
#include "shared/opacity.glsl"
#include "shared/projection.glsl"

layout(location = 0) out vec4 accumulated;

void main() {
    accumulated = vec4(no_sample().rgb, 1.0);
}
