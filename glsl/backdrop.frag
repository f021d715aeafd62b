// What is behind the volume, in every pixel of the view, before the volume is drawn [Stegmaier05 §4].
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [BACKDROP_PICTURE]

#include "shared/frame.glsl"
#include "shared/pixel.glsl"
#include "shared/backdrop.glsl"

layout(location = 0) out vec4 seen;

void main() {
    seen = vec4(backdrop_straight(this_pixel()), 1.0);
}
