// Writes the stored depths of a case by drawing them.
#version 460

layout(set = 0, binding = 0) uniform sampler2D stored;

layout(location = 0) out float color;

void main() {
    gl_FragDepth = texelFetch(stored, ivec2(gl_FragCoord.xy), 0).r;
    color = 0.0;
}
