// What the texture unit interpolates at a list of places, for a host that knows what is right. Twin:
// src/math/interpolate.rs.
#version 460

layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler3D volume;
layout(set = 0, binding = 1, std430) readonly buffer Places {
    // Texture coordinates; w is not read.
    vec4 at[];
} places;
layout(set = 0, binding = 2, std430) writeonly buffer Found {
    float values[];
} found;

void main() {
    uint i = gl_GlobalInvocationID.x;
    found.values[i] = textureLod(volume, places.at[i].xyz, 0.0).r;
}
