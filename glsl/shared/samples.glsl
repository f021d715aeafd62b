// Samples along a ray: how many and where. Twin: src/reference/samples.rs. Needs frame.glsl.

layout(set = 0, binding = 1) uniform sampler2D entry;
layout(set = 0, binding = 2) uniform sampler2D direction;

struct Ray {
    // Texture coordinates of the entry point.
    vec3 entry;
    // From one sample to the next, texture coordinates.
    vec3 step_vector;
    // Length inside the volume, in steps.
    float steps;
    // Samples on the ray.
    uint samples;
};

// The ray of this fragment's pixel, from what the first two passes stored [KW03 §2.1].
Ray load_ray() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 unit = texelFetch(direction, pixel, 0);
    Ray ray;
    ray.entry = texelFetch(entry, pixel, 0).xyz;
    ray.step_vector = unit.xyz * frame.inverse_extent[0].xyz * frame.step_length;
    ray.steps = unit.w * frame.inverse_step;
    ray.samples = uint(max(ceil(ray.steps - frame.offset), 0.0));
    return ray;
}

// Position from the index, never from adding steps up.
vec3 sample_position(Ray ray, uint i) {
    return fma(vec3(float(i) + frame.offset), ray.step_vector, ray.entry);
}
