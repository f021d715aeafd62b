// The scalar field: trilinear interpolation with clamp to edge, voxel centres at (i + 0.5) / n.
// Twin: src/math/interpolate.rs. Needs frame.glsl and samples.glsl.

#ifdef STACK
layout(set = 0, binding = 3) uniform sampler2DArray stack;
// Samples lie between textures too, and take their values from two of them.
layout(constant_id = 52) const bool BETWEEN = true;

// What is along the columns, the rows and the layers of the stack across the axis of its slices. Twin: stack_axes in src/resource/look.rs.
ivec3 in_stack(ivec3 voxel) {
    return SLICE_SURFACE == 0 ? voxel.yzx : SLICE_SURFACE == 1 ? voxel.xzy : voxel;
}

vec3 in_stack(vec3 place) {
    return SLICE_SURFACE == 0 ? place.yzx : SLICE_SURFACE == 1 ? place.xzy : place;
}
#else
layout(set = 0, binding = 3) uniform sampler3D volume;
#endif
#ifdef HOLES
layout(set = 0, binding = 4) uniform usampler3D holes;
#endif

// Who interpolates: the texture unit (8 or 9 fractional bits on most), the shader in f32, or nobody.
const int HARDWARE = 0;
const int EXACT = 1;
const int NEAREST = 2;
layout(constant_id = 1) const int FILTER = HARDWARE;

// a + w * (b - a): exactly a where both are equal.
vec4 mix_fused(vec4 a, vec4 b, float w) {
    return fma(vec4(w), b - a, a);
}

// The trilinear interpolant of the values at the corners of a cell, each of `x0` and `x1` for (y, z), (y + 1, z), (y, z + 1) and
// (y + 1, z + 1).
float interpolated(vec4 x0, vec4 x1, vec3 w) {
    vec4 x = mix_fused(x0, x1, w.x);
    vec4 y = mix_fused(x.xzxz, x.ywyw, w.y);
    return fma(w.z, y.y - y.x, y.x);
}

// The trilinear interpolant of a field between the voxels that begin at `below`, each clamped to what there is up to `last`.
float interpolate(sampler3D field, ivec3 last, vec3 below, vec3 w) {
    ivec3 a = clamp(ivec3(below), ivec3(0), last);
    ivec3 b = clamp(ivec3(below) + 1, ivec3(0), last);
    vec4 x0 = vec4(texelFetch(field, ivec3(a.x, a.y, a.z), 0).r, texelFetch(field, ivec3(a.x, b.y, a.z), 0).r,
                   texelFetch(field, ivec3(a.x, a.y, b.z), 0).r, texelFetch(field, ivec3(a.x, b.y, b.z), 0).r);
    vec4 x1 = vec4(texelFetch(field, ivec3(b.x, a.y, a.z), 0).r, texelFetch(field, ivec3(b.x, b.y, a.z), 0).r,
                   texelFetch(field, ivec3(b.x, a.y, b.z), 0).r, texelFetch(field, ivec3(b.x, b.y, b.z), 0).r);
    return interpolated(x0, x1, w);
}

// The value of a voxel.
float voxel_value(ivec3 voxel) {
#ifdef STACK
    return texelFetch(stack, in_stack(voxel), 0).r;
#else
    return texelFetch(volume, voxel, 0).r;
#endif
}

// The value at texture coordinates, as the texture unit interpolates it.
float filtered_value(vec3 place) {
#ifdef STACK
    // It interpolates in a texture, and the shader between two of them.
    vec3 at = in_stack(place);
    float last = in_stack(frame.dims.xyz).z - 1.0;
    float layer = clamp(at.z * (last + 1.0) - 0.5, 0.0, last);
    if (!BETWEEN) {
        return textureLod(stack, vec3(at.xy, round(layer)), 0.0).r;
    }
    float below = min(floor(layer), max(last - 1.0, 0.0));
    float a = textureLod(stack, vec3(at.xy, below), 0.0).r;
    float b = textureLod(stack, vec3(at.xy, min(below + 1.0, last)), 0.0).r;
    return fma(layer - below, b - a, a);
#else
    return textureLod(volume, place, 0.0).r;
#endif
}

float sample_exact(Place place) {
    ivec3 last = ivec3(frame.dims.xyz) - 1;
#ifdef STACK
    ivec3 a = clamp(ivec3(place.below), ivec3(0), last);
    ivec3 b = clamp(ivec3(place.below) + 1, ivec3(0), last);
    vec4 x0 = vec4(voxel_value(ivec3(a.x, a.y, a.z)), voxel_value(ivec3(a.x, b.y, a.z)), voxel_value(ivec3(a.x, a.y, b.z)),
                   voxel_value(ivec3(a.x, b.y, b.z)));
    vec4 x1 = vec4(voxel_value(ivec3(b.x, a.y, a.z)), voxel_value(ivec3(b.x, b.y, a.z)), voxel_value(ivec3(b.x, a.y, b.z)),
                   voxel_value(ivec3(b.x, b.y, b.z)));
    return interpolated(x0, x1, place.weight);
#else
    return interpolate(volume, last, place.below, place.weight);
#endif
}

// The value of the voxel whose centre is nearest, on each axis the later one of two that are as near.
float sample_nearest(Place place) {
    ivec3 voxel = ivec3(place.below) + ivec3(greaterThanEqual(place.weight, vec3(0.5)));
    return voxel_value(clamp(voxel, ivec3(0), ivec3(frame.dims.xyz) - 1));
}

// The value at a place, in units of the texture, as `sample_volume` has it.
float value_at(Place place) {
    if (FILTER == HARDWARE) {
        return filtered_value((place.below + place.weight + 0.5) / frame.dims.xyz);
    }
    return FILTER == NEAREST ? sample_nearest(place) : sample_exact(place);
}

// An artificial cost: so many further fetches, each where the one before it says. It changes no picture.
layout(constant_id = 11) const uint EXTRA_FETCHES = 0;

float burdened(float value) {
    // Any two numbers apart: equal values lead along the three axes to different places.
    const vec2 APART = vec2(0.37, 0.71);
    float found = value;
    for (uint fetch = 0u; fetch < EXTRA_FETCHES; ++fetch) {
        found = filtered_value(fract(vec3(found, APART.x + found, APART.y - found)));
    }
    // Bits of a signalling NaN, which no texture holds; no compiler knows.
    return floatBitsToUint(found) == 0x7f800001u ? 0.0 : value;
}

// Scalar value `steps` from the entry point, in units of the texture.
float sample_volume(Ray ray, float steps) {
    if (FILTER == HARDWARE) {
        return burdened(filtered_value(position_at(ray, steps)));
    }
    Place place = place_at(ray, steps);
    return burdened(FILTER == NEAREST ? sample_nearest(place) : sample_exact(place));
}

// Whether sample `i` lies in a cell that stays transparent since a corner is not a finite number.
bool in_hole(Ray ray, uint i) {
#ifdef HOLES
    return texelFetch(holes, cell_of(place_at(ray, steps_to(i))), 0).r != 0u;
#else
    return false;
#endif
}
