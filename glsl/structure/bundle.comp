// Distances along bundles of rays, `optimal` and `cone` [Thesis §5.3.1, §5.7]: how far every ray through a cell, of a
// view or near its directions, goes before it may meet an interesting cell. What a bundle reaches, and why the bound
// holds, stands in the twin, src/structure/bundle.rs, which is the same operation by operation. Run for boxes of several
// cells first, where the search for smaller ones begins. Four boxes, a word, an invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
//@variant first
//@variant next LARGER

#include "shared/slice.glsl"

// The Rust side is src/shared/bundle.rs. Lengths in voxels of the finest spacing, from the first voxel's centre.
layout(set = 0, binding = 0, std140) uniform Bundle {
    vec4 eye;
    // Sides of a cell of the grid.
    vec4 sides;
    // Faces of the volume.
    vec4 low;
    vec4 high;
    // 2 sin(t/2) of a cone; 0 for the rays of the view.
    float spread;
    // Length of a short step.
    float short_step;
} bundle;

// Distance in any direction, whole voxels.
layout(set = 0, binding = 10) uniform usampler3D omni_distance;
// Any interesting cell among 2^3, and 4^3, from each cell on.
layout(set = 0, binding = 12, std430) readonly buffer Wide2 {
    uint words[];
} wide_2;
layout(set = 0, binding = 13, std430) readonly buffer Wide4 {
    uint words[];
} wide_4;
layout(set = 0, binding = 14, std430) writeonly buffer DistanceBytes {
    uint words[];
} distance_bytes;
#ifdef LARGER
// The same of boxes twice as large.
layout(set = 0, binding = 15, std430) readonly buffer Larger {
    uint words[];
} larger;
#endif

// Room for f32, voxels.
const float MARGIN = 1.0 / 512.0;
// Steps before the search ends where it is.
const uint STEPS = 1024u;
const uint FAR = 255u;
// How much wider the cones of boxes of several cells are, and how far from the eye that is enough; in half diagonals.
const float WIDER = 3.0;
const float AWAY = 3.0;

ivec3 cells() {
    return ivec3(slice.cells_x, slice.cells_y, slice.cells_z);
}

// Side of a box in cells, and boxes along each side.
int scale() {
    return int(slice.cell);
}

ivec3 boxes() {
    return (cells() + scale() - 1) / scale();
}

#ifdef LARGER
uint of_larger(ivec3 box) {
    ivec3 at = box / 2;
    ivec3 count = (cells() + 2 * scale() - 1) / (2 * scale());
    uint word = uint((at.z * count.y + at.y) * ((count.x + 3) / 4) + at.x / 4);
    return bitfieldExtract(larger.words[word], 8 * (at.x & 3), 8);
}
#endif

float dot_in_order(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

ivec3 cell_of(vec3 place) {
    precise vec3 quotient = place / bundle.sides.xyz;
    return ivec3(clamp(floor(quotient), vec3(0.0), vec3(cells() - 1)));
}

bool wide_at(ivec3 at, bool four) {
    uint word = uint(at.z * cells().y + at.y) * words(slice.cells_x) + uint(at.x >> 5);
    uint bits = four ? wide_4.words[word] : wide_2.words[word];
    return (bits >> (at.x & 31) & 1u) != 0u;
}

// Whether a cell from `first` to `last` is interesting; a window of more than 8 cells counts as one that is.
bool meets(ivec3 first, ivec3 last) {
    ivec3 width = last - first;
    int widest = max(width.x, max(width.y, width.z));
    if (widest >= 8) {
        return true;
    }
    bool four = widest >= 4;
    // Two overlapping lookups on an axis where one does not cover the window.
    ivec3 other = max(last + 1 - (four ? 4 : 2), first);
    for (int z = first.z;; z = other.z) {
        for (int y = first.y;; y = other.y) {
            if (wide_at(ivec3(first.x, y, z), four) || (other.x != first.x && wide_at(ivec3(other.x, y, z), four))) {
                return true;
            }
            if (y == other.y) {
                break;
            }
        }
        if (z == other.z) {
            break;
        }
    }
    return false;
}

// A cell's bundle.
struct Rays {
    vec3 middle;
    vec3 half_side;
    vec3 direction;
    vec3 spreads;
};

vec3 centre_at(Rays rays, float way) {
    precise vec3 centre = rays.middle + way * rays.direction;
    return centre;
}

vec3 side_at(Rays rays, float way) {
    precise vec3 side = rays.half_side + way * rays.spreads;
    return side;
}

uint distance_of(ivec3 box) {
#ifdef LARGER
    uint known = of_larger(box);
#else
    const uint known = 0u;
#endif
    if (known == FAR) {
        return FAR;
    }
    uint least = scale() == 1 ? max(known, texelFetch(omni_distance, box, 0).r) : known;
    precise vec3 begin = mix(vec3(box * scale()) * bundle.sides.xyz, bundle.low.xyz, equal(box, ivec3(0)));
    precise vec3 end = mix(vec3((box + 1) * scale()) * bundle.sides.xyz, bundle.high.xyz, equal(box + 1, boxes()));
    Rays rays;
    precise vec3 middle = 0.5 * (begin + end);
    precise vec3 half_side = 0.5 * (end - begin);
    precise vec3 from_eye = middle - bundle.eye.xyz;
    precise float away = sqrt(dot_in_order(from_eye, from_eye));
    precise float radius = sqrt(dot_in_order(half_side, half_side));
    precise float too_near = scale() == 1 ? radius + 1.0 : AWAY * radius;
    // Seen from within, rays go anywhere.
    if (away <= too_near) {
        return least;
    }
    bool cone = bundle.spread > 0.0;
    precise vec3 direction = from_eye / away;
    precise float wider = scale() == 1 ? bundle.spread : bundle.spread + WIDER * (radius / away);
    precise vec3 spreads = cone ? vec3(wider) : half_side / away;
    precise float widening = cone ? wider : radius / away;
    precise float shortened = cone ? 1.0 : (away - radius) / away;
    precise float lengthened = cone ? 1.0 : (away + radius) / away;
    precise float short_step = bundle.short_step * float(scale());
    rays = Rays(middle, half_side, direction, spreads);
    precise float free = float(known) / lengthened;
    for (uint i = 0u; i < STEPS; ++i) {
        if (free * shortened > 257.0) {
            break;
        }
        vec3 here = centre_at(rays, free);
        vec3 side = side_at(rays, free);
        precise vec3 lowest = here - side;
        precise vec3 highest = here + side;
        if (any(lessThan(highest, bundle.low.xyz)) || any(greaterThan(lowest, bundle.high.xyz))) {
            // Rays that have left do not come back.
            return FAR;
        }
        float omni = float(texelFetch(omni_distance, cell_of(here), 0).r);
        precise float room = omni - (radius + widening * free) - MARGIN;
        if (room > short_step) {
            free += room / (1.0 + widening);
            continue;
        }
        precise float after = free + short_step;
        vec3 there = centre_at(rays, after);
        vec3 side_there = side_at(rays, after);
        precise vec3 from = min(lowest, there - side_there) - MARGIN;
        precise vec3 to = max(highest, there + side_there) + MARGIN;
        if (meets(cell_of(from), cell_of(to))) {
            break;
        }
        free = after;
    }
    precise float whole = floor(free * shortened - MARGIN);
    return max(uint(clamp(whole, 0.0, float(FAR))), least);
}

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    ivec3 count = boxes();
    uint in_row = uint(count.x + 3) / 4u;
    uint begin = index % in_row * 4u;
    uint end = min(begin + 4u, uint(count.x));
    uint row = index / in_row;
    uint word = 0u;
    for (uint x = begin; x < end; ++x) {
        word |= distance_of(ivec3(x, row % uint(count.y), row / uint(count.y))) << (8u * (x - begin));
    }
    distance_bytes.words[index] = word;
}
