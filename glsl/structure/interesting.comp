// Which cells of a grid are interesting: those over whose range of values the transfer function shows anything; where
// samples have the value of the nearest voxel, those with a voxel that shows. One bit a cell, 32 cells of a row in a word,
// one word an invocation. Twin: src/structure/cells.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
//@takes [RANGES | NEAREST], [HOLES]

#include "shared/slice.glsl"

// Where the transfer function shows anything: closed intervals of the texture's values, rising and apart.
layout(set = 0, binding = 11, std430) readonly buffer Support {
    vec2 intervals[];
} support;
layout(set = 0, binding = 12, std430) writeonly buffer Interesting {
    uint words[];
} interesting;
#ifdef RANGES
layout(set = 0, binding = 8, std430) readonly buffer CellRange {
    vec2 ranges[];
} cell_range;
#else
layout(set = 0, binding = 3) uniform sampler3D volume;
#endif
#ifdef HOLES
layout(set = 0, binding = 4) uniform usampler3D holes;
#endif

layout(constant_id = 0) const uint INTERVALS = 1;

// How far interpolation, or a texture unit's own idea of a code, may leave a range, relative to its larger magnitude.
const float ROUNDING = exp2(-20.0);
const float CODE_ROUNDING = exp2(-22.0);
const float SMALLEST = exp2(-126.0);

bool visible(vec2 range) {
    float relative = range.x < range.y ? ROUNDING : CODE_ROUNDING;
    precise float by = max(max(abs(range.x), abs(range.y)) * relative, SMALLEST);
    if (range.x == 0.0 && range.y == 0.0) {
        by = 0.0;
    }
    precise float low = range.x - by;
    precise float high = range.y + by;
    for (uint i = 0u; i < INTERVALS; ++i) {
        vec2 interval = support.intervals[i];
        if (low <= interval.y && high >= interval.x) {
            return true;
        }
    }
    return false;
}

#ifdef NEAREST
// Whether any voxel of the cell `first` of the grid shows something.
bool any_visible(ivec3 first, ivec3 last) {
    ivec3 begin = first * int(slice.cell);
    ivec3 end = min(begin + int(slice.cell), last);
    for (int z = begin.z; z <= end.z; ++z) {
        for (int y = begin.y; y <= end.y; ++y) {
            for (int x = begin.x; x <= end.x; ++x) {
                if (visible(vec2(texelFetch(volume, ivec3(x, y, z), 0).r))) {
                    return true;
                }
            }
        }
    }
    return false;
}
#elif !defined(RANGES)
// Range of the four voxels at `x` that the cells of row (y, z) share.
vec2 column_range(int x, ivec2 y, ivec2 z) {
    float a = texelFetch(volume, ivec3(x, y.x, z.x), 0).r;
    float b = texelFetch(volume, ivec3(x, y.y, z.x), 0).r;
    float c = texelFetch(volume, ivec3(x, y.x, z.y), 0).r;
    float d = texelFetch(volume, ivec3(x, y.y, z.y), 0).r;
    return vec2(min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}
#endif

void main() {
    uint index = invocation();
    if (index >= slice.end) {
        return;
    }
    uint in_row = words(slice.cells_x);
    uint row = index / in_row;
    uint begin = index % in_row * 32u;
    uint end = min(begin + 32u, slice.cells_x);
    uint bits = 0u;
#ifdef RANGES
    for (uint x = begin; x < end; ++x) {
        bits |= uint(visible(cell_range.ranges[row * slice.cells_x + x])) << (x - begin);
    }
#elif defined(NEAREST)
    ivec2 yz = ivec2(row % slice.cells_y, row / slice.cells_y);
    for (uint x = begin; x < end; ++x) {
        bool shows = any_visible(ivec3(x, yz), textureSize(volume, 0) - 1);
#ifdef HOLES
        shows = shows && texelFetch(holes, ivec3(x, yz), 0).r == 0u;
#endif
        bits |= uint(shows) << (x - begin);
    }
#else
    ivec3 last = textureSize(volume, 0) - 1;
    ivec2 y = min(int(row % slice.cells_y) + ivec2(0, 1), last.y);
    ivec2 z = min(int(row / slice.cells_y) + ivec2(0, 1), last.z);
    vec2 before = column_range(int(begin), y, z);
    for (uint x = begin; x < end; ++x) {
        vec2 after = column_range(min(int(x) + 1, last.x), y, z);
        bool shows = visible(vec2(min(before.x, after.x), max(before.y, after.y)));
#ifdef HOLES
        shows = shows && texelFetch(holes, ivec3(x, y.x, z.x), 0).r == 0u;
#endif
        bits |= uint(shows) << (x - begin);
        before = after;
    }
#endif
    interesting.words[index] = bits;
}
