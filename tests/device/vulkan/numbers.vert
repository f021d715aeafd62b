// `numbers` as a buffer where `numbers.frag` has a texture.
#version 460

layout(set = 0, binding = 0, std430) readonly buffer Numbers {
    vec4 corners[];
} numbers;

void main() {
    gl_Position = numbers.corners[gl_VertexIndex];
}
