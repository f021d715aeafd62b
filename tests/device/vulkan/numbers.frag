// Declares what `count.comp` and `color.frag` declare, in other ways.
#version 460

layout(set = 0, binding = 0) uniform sampler2D numbers;

layout(location = 0) out vec4 color;

void main() {
    color = texelFetch(numbers, ivec2(0), 0);
}
