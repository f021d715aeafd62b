// The gradient of the scalar field. Twin: src/twin/gradient.rs. Needs frame.glsl, samples.glsl and volume.glsl.
//
// Central differences, taken here; with GRADIENTS interpolated from a texture that was made before (structure/gradients.comp), which
// has the value beside them [Stegmaier05 §4].

#ifdef GRADIENTS
layout(set = 0, binding = 23) uniform sampler3D gradients;

// The value of the volume's texture is the first times the value beside the gradient and the second.
layout(constant_id = 24) const float VALUE_TIMES = 1.0;
layout(constant_id = 25) const float VALUE_PLUS = 0.0;
// Gradients are codes of 8 bits: 0 is code 128, and what is shorter than a 512th of a code is 0 rounded.
layout(constant_id = 26) const bool GRADIENT_CODES = false;

const float NO_GRADIENT = 1.0 / 512.0;

// The texel of a place, interpolated as values are.
vec4 gradient_texel(Place place) {
    ivec3 last = ivec3(frame.dims.xyz) - 1;
    ivec3 a = ivec3(place.below);
    if (FILTER == HARDWARE) {
        return textureLod(gradients, (place.below + place.weight + 0.5) / frame.dims.xyz, 0.0);
    }
    if (FILTER == NEAREST) {
        return texelFetch(gradients, clamp(a + ivec3(greaterThanEqual(place.weight, vec3(0.5))), ivec3(0), last), 0);
    }
    vec4 plane[2];
    for (int z = 0; z < 2; ++z) {
        vec4 row[2];
        for (int y = 0; y < 2; ++y) {
            vec4 x0 = texelFetch(gradients, clamp(a + ivec3(0, y, z), ivec3(0), last), 0);
            vec4 x1 = texelFetch(gradients, clamp(a + ivec3(1, y, z), ivec3(0), last), 0);
            row[y] = mix_fused(x0, x1, place.weight.x);
        }
        plane[z] = mix_fused(row[0], row[1], place.weight.y);
    }
    return mix_fused(plane[0], plane[1], place.weight.z);
}

// A vector along the gradient in volume space, of a texel.
vec3 gradient_of(vec4 texel) {
    if (!GRADIENT_CODES) {
        return texel.rgb;
    }
    vec3 codes = fma(texel.rgb, vec3(255.0), vec3(-128.0));
    return max(max(abs(codes.x), abs(codes.y)), abs(codes.z)) < NO_GRADIENT ? vec3(0.0) : codes;
}

// The value beside it, in units of the volume's texture.
float value_of(vec4 texel) {
    return fma(texel.a, VALUE_TIMES, VALUE_PLUS);
}

vec3 gradient_at(Place place) {
    return gradient_of(gradient_texel(place));
}

// As `burdened`, with fetches of the texture that such samples read.
float burdened_beside(float value) {
    const vec2 APART = vec2(0.37, 0.71);
    float found = value;
    for (uint fetch = 0u; fetch < EXTRA_FETCHES; ++fetch) {
        found = textureLod(gradients, fract(vec3(found, APART.x + found, APART.y - found)), 0.0).a;
    }
    return floatBitsToUint(found) == 0x7f800001u ? 0.0 : value;
}
#else
// The place `by` voxels along an axis, but not beyond the outermost voxel centres.
Place beside(Place place, int axis, float by) {
    float last = frame.dims[axis] - 1.0;
    place.below[axis] += by;
    if (place.below[axis] < 0.0 || place.below[axis] >= last) {
        place.below[axis] = place.below[axis] < 0.0 ? 0.0 : last;
        place.weight[axis] = 0.0;
    }
    return place;
}

// A vector along the gradient in volume space: differences of the values a voxel to each side, over the way between the two, in
// units of the texture over the finest spacing. 0 along an axis of one voxel.
vec3 gradient_at(Place place) {
    vec3 gradient = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        Place up = beside(place, axis, 1.0);
        Place down = beside(place, axis, -1.0);
        float way = (up.below[axis] - down.below[axis]) + (up.weight[axis] - down.weight[axis]);
        if (way > 0.0) {
            // Voxels along this axis in one of the finest spacing.
            float finest = frame.voxel_step[0][axis] / frame.step_voxels;
            gradient[axis] = (value_at(up) - value_at(down)) / way * finest;
        }
    }
    return gradient;
}
#endif
