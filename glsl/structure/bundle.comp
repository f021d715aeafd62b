// Distances along bundles of rays, `optimal` and `cone` [Thesis §5.3.1, §5.7]: how far every ray through a cell, of a
// view or near its directions, goes before it may meet an interesting cell. What a bundle reaches, and why the bound
// holds, stands in the twin, src/structure/bundle.rs, which is the same operation by operation. Run for boxes of several
// cells first, where the search for smaller ones begins. Four boxes, a word, an invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [LARGER], [PARALLEL]

#include "shared/slice.glsl"

// The Rust side is src/shared/bundle.rs. Lengths in voxels of the finest spacing, from the first voxel's centre.
layout(set = 0, binding = 0, std140) uniform Bundle {
    // The eye; PARALLEL: the one direction of all rays.
    vec4 from;
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

// Distance in any direction: 0 for interesting cells, else whole voxels and one more.
layout(set = 0, binding = 10) uniform usampler3D omni_distance;
// Interesting cells, and any among 2^3, and 4^3, from each cell on.
layout(set = 0, binding = 11, std430) readonly buffer Interesting {
    uint words[];
} interesting;
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
// The same of boxes twice as large, which are not said to be interesting.
layout(set = 0, binding = 15, std430) readonly buffer Larger {
    uint words[];
} larger;
#endif

// Room for f32, voxels.
const float MARGIN = 1.0 / 512.0;
// Steps before the search ends where it is.
const uint STEPS = 1024u;
// The largest distance kept.
const uint FAR = 254u;
// More than any distance that is told apart, in voxels.
const float BEYOND = 257.0;
// So many voxels, known of the larger box, are not searched for more.
const uint ENOUGH = 32u;
// Cells along the side of the largest window whose cells are looked at one by one.
const int WINDOW = 5;
// A direction that changes a coordinate by less than this in a voxel bounds nothing.
const float ALONG = 1e-6;
// How much wider cones are for what directions to points of a cell, or of a box of several, differ, and how far from the
// eye that is enough; in half diagonals.
const float WITHIN = 1.5;
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

uint free_of(uint byte) {
    return max(byte, 1u) - 1u;
}

uint omni_at(ivec3 cell) {
    return free_of(texelFetch(omni_distance, cell, 0).r);
}

#ifdef LARGER
uint of_larger(ivec3 box) {
    ivec3 at = box / 2;
    ivec3 count = (cells() + 2 * scale() - 1) / (2 * scale());
    uint word = uint((at.z * count.y + at.y) * ((count.x + 3) / 4) + at.x / 4);
    return free_of(bitfieldExtract(larger.words[word], 8 * (at.x & 3), 8));
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

uint word_of(ivec3 at) {
    return uint(at.z * cells().y + at.y) * words(slice.cells_x) + uint(at.x >> 5);
}

bool wide_at(ivec3 at, bool four) {
    uint bits = four ? wide_4.words[word_of(at)] : wide_2.words[word_of(at)];
    return (bits >> (at.x & 31) & 1u) != 0u;
}

// A bit for each of the `count` (up to 8) cells along x from `at` on: whether it is interesting.
uint interesting_from(ivec3 at, int count) {
    uint word = word_of(at);
    int bit = at.x & 31;
    uint bits = interesting.words[word] >> bit;
    if (bit + count > 32) {
        bits |= interesting.words[word + 1u] << (32 - bit);
    }
    return bits & ((1u << count) - 1u);
}

// Faces of a box of `side`^3 cells, one of `count`; those at the border are the volume's.
vec3 begin_of(ivec3 at, int side) {
    precise vec3 begin = mix(vec3(at * side) * bundle.sides.xyz, bundle.low.xyz, equal(at, ivec3(0)));
    return begin;
}

vec3 end_of(ivec3 at, int side, ivec3 count) {
    precise vec3 end = mix(vec3((at + 1) * side) * bundle.sides.xyz, bundle.high.xyz, equal(at + 1, count));
    return end;
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

// The way, `free` or more, after which the bundle reaches into a box; BEYOND where it passes by.
float enter(Rays rays, vec3 begin, vec3 end, float free) {
    precise vec3 apart = 0.5 * (begin + end) - rays.middle;
    precise vec3 reach = rays.half_side + 0.5 * (end - begin) + MARGIN;
    precise vec3 slow = rays.direction - rays.spreads;
    precise vec3 fast = rays.direction + rays.spreads;
    precise vec3 most = (apart + reach) / slow;
    precise vec3 least = (apart - reach) / fast;
    float from = free;
    float to = BEYOND;
    for (int a = 0; a < 3; ++a) {
        if (slow[a] > ALONG) {
            to = min(to, most[a]);
        } else if (slow[a] < -ALONG) {
            from = max(from, most[a]);
        }
        if (fast[a] > ALONG) {
            from = max(from, least[a]);
        } else if (fast[a] < -ALONG) {
            to = min(to, least[a]);
        }
    }
    return from <= to ? from : BEYOND;
}

// Whether a cell lies where no ray of the bundle goes, on some axis, though the boxes may touch.
bool behind(ivec3 way, Rays rays) {
    precise vec3 slow = rays.direction - rays.spreads;
    precise vec3 fast = rays.direction + rays.spreads;
    bvec3 up = greaterThan(slow, vec3(ALONG));
    bvec3 down = lessThan(fast, vec3(-ALONG));
    for (int a = 0; a < 3; ++a) {
        if ((way[a] < 0 && up[a]) || (way[a] > 0 && down[a])) {
            return true;
        }
    }
    return false;
}

// How far the rays of cell `at` go before they meet the first of the interesting cells from `first` to `last`.
float nearest_of(ivec3 at, Rays rays, ivec3 first, ivec3 last, float free, float shortened) {
    float nearest = BEYOND;
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            uint bits = interesting_from(ivec3(first.x, y, z), last.x - first.x + 1);
            while (bits != 0u) {
                ivec3 cell = ivec3(first.x + findLSB(bits), y, z);
                bits &= bits - 1u;
                if (behind(cell - at, rays)) {
                    continue;
                }
                precise vec3 gap = vec3(max(abs(cell - at) - 1, ivec3(0))) * bundle.sides.xyz;
                precise float way = enter(rays, begin_of(cell, 1), end_of(cell, 1, cells()), free) * shortened;
                precise float apart = sqrt(dot_in_order(gap, gap));
                nearest = min(nearest, max(apart, way));
            }
        }
    }
    return nearest;
}

// Voxels that are free along every ray of the box.
uint free_from(ivec3 box) {
#ifdef LARGER
    uint known = of_larger(box);
#else
    const uint known = 0u;
#endif
    uint least = scale() == 1 ? max(known, omni_at(box)) : known;
    if (known >= ENOUGH) {
        return least;
    }
    vec3 begin = begin_of(box, scale());
    vec3 end = end_of(box, scale(), boxes());
    Rays rays;
    precise vec3 middle = 0.5 * (begin + end);
    precise vec3 half_side = 0.5 * (end - begin);
    precise float radius = sqrt(dot_in_order(half_side, half_side));
#ifdef PARALLEL
    vec3 direction = bundle.from.xyz;
    vec3 spreads = vec3(bundle.spread);
    float widening = bundle.spread;
    const float shortened = 1.0;
    const float lengthened = 1.0;
#else
    bool cone = bundle.spread > 0.0;
    precise vec3 from_eye = middle - bundle.from.xyz;
    precise float away = sqrt(dot_in_order(from_eye, from_eye));
    precise float too_near = scale() == 1 ? radius + 1.0 : AWAY * radius;
    // Seen from within, rays go anywhere.
    if (away <= too_near) {
        return least;
    }
    precise vec3 direction = from_eye / away;
    precise float wider = bundle.spread + (scale() == 1 ? WITHIN : WIDER) * (radius / away);
    precise vec3 spreads = cone ? vec3(wider) : half_side / away;
    precise float widening = cone ? wider : radius / away;
    precise float shortened = cone ? 1.0 : (away - radius) / away;
    precise float lengthened = cone ? 1.0 : (away + radius) / away;
#endif
    precise float short_step = bundle.short_step * float(scale());
    rays = Rays(middle, half_side, direction, spreads);
    precise float free = float(known) / lengthened;
    precise float nearest = BEYOND;
    uint steps = 0u;
    while (free * shortened < nearest) {
        vec3 here = centre_at(rays, free);
        vec3 side = side_at(rays, free);
        precise vec3 lowest = here - side;
        precise vec3 highest = here + side;
        // Rays that have left do not come back.
        if (any(lessThan(highest, bundle.low.xyz)) || any(greaterThan(lowest, bundle.high.xyz))) {
            break;
        }
        ++steps;
        if (steps > STEPS) {
            nearest = free * shortened;
            break;
        }
        float omni = float(omni_at(cell_of(here)));
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
        ivec3 first = cell_of(from);
        ivec3 last = cell_of(to);
        if (meets(first, last)) {
            if (scale() > 1 || any(greaterThanEqual(last - first, ivec3(WINDOW)))) {
                nearest = free * shortened;
                break;
            }
            nearest = min(nearest, nearest_of(box, rays, first, last, free, shortened));
        }
        free = after;
    }
    precise float whole = floor(nearest - MARGIN);
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
        ivec3 box = ivec3(x, row % uint(count.y), row / uint(count.y));
        bool itself = scale() == 1 && interesting_from(box, 1) != 0u;
        word |= (itself ? 0u : free_from(box) + 1u) << (8u * (x - begin));
    }
    distance_bytes.words[index] = word;
}
