// The gradient at every voxel's centre, in parts of the steepest there may be, and the value beside it [Stegmaier05 §4]: central
// differences, or with SOBEL the weighted ones of 3x3x3 voxels. One texel an invocation; beyond the outermost voxels they repeat.
// Twin: src/structure/gradients.rs, to the bit: nothing here may be contracted or put in another order.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes RGBA8 | RGBA16F | RGBA32F, [SOBEL]

#include "shared/slice.glsl"

layout(set = 0, binding = 3) uniform sampler3D volume;
layout(set = 0, binding = 24, std430) writeonly buffer GradientTexels {
    uint words[];
} gradient_texels;

// How voxels become texels (`GradientCoding` in src/scene/gradients.rs).
layout(constant_id = 0) const bool WHOLE = false;
layout(constant_id = 1) const float SCALE = 1.0;
layout(constant_id = 2) const float FACTOR_X = 1.0;
layout(constant_id = 3) const float FACTOR_Y = 1.0;
layout(constant_id = 4) const float FACTOR_Z = 1.0;
layout(constant_id = 5) const float BESIDE_TIMES = 1.0;
layout(constant_id = 6) const float BESIDE_PLUS = 0.0;

// What keeps whole numbers in the middle between two codes from becoming one or the other by rounding.
const float TIE = 1e-3;
// The code of 8 bits that stands for a component of 0, and how many codes there are to each side of it.
const float ZERO_CODE = 128.0;
const float CODES = 127.0;

// The number of a voxel.
float number_at(ivec3 place) {
    precise float value = texelFetch(volume, clamp(place, ivec3(0), textureSize(volume, 0) - 1), 0).r * SCALE;
    return WHOLE ? round(value) : value;
}

float difference(ivec3 place, int axis) {
    place[axis] = clamp(place[axis], 0, textureSize(volume, 0)[axis] - 1);
    ivec3 up = place;
    ivec3 down = place;
    up[axis] += 1;
    down[axis] -= 1;
    precise float apart = number_at(up) - number_at(down);
    return apart;
}

float component(ivec3 place, int axis, float factor) {
#ifdef SOBEL
    int second = (axis + 1) % 3;
    int third = (axis + 2) % 3;
    precise float sum = 0.0;
    for (int b = -1; b <= 1; ++b) {
        for (int a = -1; a <= 1; ++a) {
            ivec3 there = place;
            there[second] += a;
            there[third] += b;
            precise float weighted = float((2 - abs(a)) * (2 - abs(b))) * difference(there, axis);
            sum = sum + weighted;
        }
    }
    precise float apart = sum * (1.0 / 16.0);
#else
    float apart = difference(place, axis);
#endif
    bool inside = place[axis] > 0 && place[axis] + 1 < textureSize(volume, 0)[axis];
    precise float part = apart * (inside ? 0.5 : 1.0) * factor;
    return clamp(part, -1.0, 1.0);
}

#ifdef RGBA16F
// The nearest number of half precision, of two the even one: packing may round as it likes what is one.
float halved(float value) {
    const float LEAST_NORMAL = 1.0 / 16384.0;
    const float SUBNORMALS = 16777216.0;
    if (abs(value) < LEAST_NORMAL) {
        return roundEven(value * SUBNORMALS) * (1.0 / SUBNORMALS);
    }
    uint bits = floatBitsToUint(value);
    return uintBitsToFloat((bits + 0xfffu + ((bits >> 13) & 1u)) & ~0x1fffu);
}
#endif

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint row = index / slice.cells_x;
    ivec3 place = ivec3(index % slice.cells_x, row % slice.cells_y, row / slice.cells_y);
    vec3 gradient =
        vec3(component(place, 0, FACTOR_X), component(place, 1, FACTOR_Y), component(place, 2, FACTOR_Z));
    precise float scaled = number_at(place) * BESIDE_TIMES;
    precise float value = scaled + BESIDE_PLUS;
#if defined(RGBA8)
    precise vec3 times = gradient * CODES;
    precise vec3 codes = times + (ZERO_CODE + 0.5 + TIE);
    precise float of_value = value * 255.0;
    of_value = of_value + (0.5 + TIE);
    uvec4 texel = uvec4(clamp(floor(vec4(codes, of_value)), 0.0, 255.0));
    gradient_texels.words[index] = texel.r | texel.g << 8 | texel.b << 16 | texel.a << 24;
#elif defined(RGBA16F)
    gradient_texels.words[2u * index] = packHalf2x16(vec2(halved(gradient.x), halved(gradient.y)));
    gradient_texels.words[2u * index + 1u] = packHalf2x16(vec2(halved(gradient.z), halved(value)));
#else
    gradient_texels.words[4u * index] = floatBitsToUint(gradient.x);
    gradient_texels.words[4u * index + 1u] = floatBitsToUint(gradient.y);
    gradient_texels.words[4u * index + 2u] = floatBitsToUint(gradient.z);
    gradient_texels.words[4u * index + 3u] = floatBitsToUint(value);
#endif
}
