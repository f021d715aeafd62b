// An array of textures beside a buffer: sums texel (0, 0) of both.
#version 460

layout(local_size_x = 1) in;

layout(set = 0, binding = 2) uniform sampler2D textures[2];
layout(set = 0, binding = 5, std430) buffer Total {
    float sum;
} total;

void main() {
    total.sum = texelFetch(textures[0], ivec2(0), 0).r + 10.0 * texelFetch(textures[1], ivec2(0), 0).r;
}
