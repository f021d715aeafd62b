// Where a ray meets a value exactly: the interpolant along a ray is a cubic in every cell. Twin: src/truth/exact/first.rs. Needs
// frame.glsl, samples.glsl and volume.glsl.

// The corners of the cell whose lowest voxel is `below`, x fastest, less `level`; beyond the outermost centres voxels repeat.
void corners_of(vec3 below, float level, out float corners[8]) {
    ivec3 last = ivec3(frame.dims.xyz) - 1;
    ivec3 low = ivec3(below);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 voxel = low + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        corners[corner] = texelFetch(volume, clamp(voxel, ivec3(0), last), 0).r - level;
    }
}

// The coefficients of the interpolant along the way whose weights are start + s * rise, s from 0 to 1.
vec4 cubic_of(float k[8], vec3 start, vec3 rise) {
    // Differences along each axis, then each weight put in as a polynomial of s, an axis at a time.
    for (int bit = 1; bit <= 4; bit <<= 1) {
        for (int corner = 0; corner < 8; ++corner) {
            if ((corner & bit) != 0) {
                k[corner] -= k[corner ^ bit];
            }
        }
    }
    vec4 folded[8];
    for (int i = 0; i < 8; ++i) {
        folded[i] = vec4(k[i], 0.0, 0.0, 0.0);
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (int pair = 0; pair < 4 >> axis; ++pair) {
            vec4 scaled = folded[2 * pair + 1];
            folded[pair] = folded[2 * pair] + scaled * start[axis] + vec4(0.0, scaled.xyz) * rise[axis];
        }
    }
    return folded[0];
}

float cubic_at(vec4 c, float s) {
    return fma(fma(fma(c.w, s, c.z), s, c.y), s, c.x);
}

// Halvings of a stretch on which a cubic rises or falls: as many as single precision has digits.
const int HALVINGS = 24;

// The first s in [from, to], on which the cubic is monotone, at which `sign` times it is not below 0; more than 1 where there is none.
float root_between(vec4 c, float sign, float from, float to) {
    if (sign * cubic_at(c, to) < 0.0) {
        return 2.0;
    }
    for (int i = 0; i < HALVINGS; ++i) {
        float middle = 0.5 * (from + to);
        if (sign * cubic_at(c, middle) < 0.0) {
            from = middle;
        } else {
            to = middle;
        }
    }
    return to;
}

// Where a cubic turns in [0, 1], rising; more than 1 where it does not.
vec2 turns_of(vec4 c) {
    // Roots of its derivative, in the form without cancellation.
    vec2 turns = vec2(2.0);
    float a = 3.0 * c.w;
    float b = 2.0 * c.z;
    float discriminant = b * b - 4.0 * a * c.y;
    if (discriminant > 0.0) {
        float q = -0.5 * (b + (b < 0.0 ? -sqrt(discriminant) : sqrt(discriminant)));
        vec2 found = vec2(a != 0.0 ? q / a : 2.0, q != 0.0 ? c.y / q : 2.0);
        found = mix(found, vec2(2.0), notEqual(clamp(found, 0.0, 1.0), found));
        turns = vec2(min(found.x, found.y), max(found.x, found.y));
    }
    return turns;
}

// The first s in [0, 1] at which `sign` times the cubic is not below 0; more than 1 where there is none.
float first_root(vec4 c, float sign) {
    if (sign * c.x >= 0.0) {
        return 0.0;
    }
    vec2 turns = turns_of(c);
    float from = 0.0;
    for (int piece = 0; piece < 3; ++piece) {
        float to = piece < 2 ? min(turns[piece], 1.0) : 1.0;
        if (to > from) {
            float root = root_between(c, sign, from, to);
            if (root <= 1.0) {
                return root;
            }
            from = to;
        }
    }
    return 2.0;
}

// A walk along a ray from cell to cell.
struct CellWalk {
    // Where it began, and how far it has come, in steps.
    Place begin;
    float at;
    // Voxels that a step goes along each axis.
    vec3 stride;
    // The lowest voxel of the cell that comes next.
    vec3 below;
};

// The part of a ray in one cell.
struct CellPart {
    // The cell's lowest voxel.
    vec3 below;
    // Its begin and end, in steps from where the walk began, and as weights between the cell's voxels.
    vec2 steps;
    vec3 from;
    vec3 to;
};

CellWalk walk_from(Ray ray, float steps) {
    Place begin = place_at(ray, steps);
    return CellWalk(begin, 0.0, ray.step_vector * frame.dims.xyz, begin.below);
}

// The next part of a walk that is so many steps long.
CellPart next_part(inout CellWalk walk, float length) {
    bvec3 up = greaterThan(walk.stride, vec3(0.0));
    vec3 passed = walk.below - walk.begin.below;
    // Where the ray leaves the cell, on each axis.
    vec3 face = passed + mix(vec3(0.0), vec3(1.0), up);
    vec3 leaves = mix((face - walk.begin.weight) / walk.stride, vec3(UNBOUNDED), equal(walk.stride, vec3(0.0)));
    float leave = clamp(min(leaves.x, min(leaves.y, leaves.z)), walk.at, length);
    vec3 from = clamp(walk.begin.weight + walk.at * walk.stride - passed, 0.0, 1.0);
    vec3 to = clamp(walk.begin.weight + leave * walk.stride - passed, 0.0, 1.0);
    CellPart part = CellPart(walk.below, vec2(walk.at, leave), from, to);
    for (int axis = 0; axis < 3; ++axis) {
        if (leaves[axis] <= leave) {
            walk.below[axis] += up[axis] ? 1.0 : -1.0;
        }
    }
    walk.at = leave;
    return part;
}

// Steps to the first place between two others, in steps, at which the field is not below `level`, or with `sign` -1 not above it;
// the second one where rounding hides it.
float first_at(Ray ray, vec2 between, float level, float sign) {
    CellWalk walk = walk_from(ray, between.x);
    float length = between.y - between.x;
    while (walk.at < length) {
        CellPart part = next_part(walk, length);
        float corners[8];
        corners_of(part.below, level, corners);
        float root = first_root(cubic_of(corners, part.from, part.to - part.from), sign);
        if (root <= 1.0) {
            return between.x + mix(part.steps.x, part.steps.y, root);
        }
        // Asked at the end as well: segment.glsl.
        if (walk.at >= length) {
            break;
        }
    }
    return between.y;
}
