// Which blocks show something [KW03 §2.3]. Twins: src/twin/block_skip.rs, and of `free_from` src/twin/near_neighbor.rs. Needs frame.glsl, samples.glsl and block.glsl.

layout(set = 0, binding = 8, std430) readonly buffer CellRange {
    vec2 ranges[];
} cell_range;
// CT [KW03 §2.3]: whether anything shows between a minimum and a maximum.
layout(set = 0, binding = 9) uniform usampler2D block_table;

// A sample stands for all values up to the next one (shared/preintegrated.glsl).
layout(constant_id = 12) const bool SPANS = false;

// A sample this near (in steps) beyond the face of a block is asked for by itself: f32 cannot tell its side.
const float BOUNDARY = 1e-3;

bool block_visible(ivec3 block) {
    ivec3 blocks = block_count(ivec3(frame.dims.xyz));
    vec2 range = cell_range.ranges[(block.z * blocks.y + block.y) * blocks.x + block.x];
    return texelFetch(block_table, range_codes(range), 0).r != 0u;
}

// Whether anything shows in the blocks from that of sample `i` to that of the next sample, or of the exit point, with
// those beside the way, whose corners a ray may cut off.
bool way_visible(Ray ray, uint i) {
    ivec3 front = cell_of(place_of(ray, i)) / BLOCK;
#ifdef SLICES
    ivec3 back = cell_of(place_of(ray, i + 1u)) / BLOCK;
#else
    ivec3 back = cell_of(place_at(ray, min(steps_to(i + 1u), ray.steps))) / BLOCK;
#endif
    ivec3 low = min(front, back);
    ivec3 high = max(front, back);
    bool visible = false;
    // Asked at the end as well: segment.glsl.
    for (ivec3 block = low; !visible && block.z <= high.z;) {
        visible = block_visible(block);
        // The next block, along x first.
        ++block.x;
        block.y += block.x > high.x ? 1 : 0;
        block.x = block.x > high.x ? low.x : block.x;
        block.z += block.y > high.y ? 1 : 0;
        block.y = block.y > high.y ? low.y : block.y;
        if (visible || block.z > high.z) {
            break;
        }
    }
    return visible;
}

// Samples after the one at `place`, in `block`, that lie in the same block, as far as f32 can tell.
uint samples_in_block(Ray ray, Place place, ivec3 block) {
    return uint(max(floor(steps_inside(ray, place, block, BLOCK) / stride_of(ray) - BOUNDARY), 0.0));
}

// Samples from `i` on that show nothing: those that lie in the same block, where that is empty. For loops that leap.
uint free_from(Ray ray, uint i) {
    Place place = place_of(ray, i);
    ivec3 block = cell_of(place) / BLOCK;
    if (block_visible(block)) {
        return 0u;
    }
    uint others = samples_in_block(ray, place, block);
    // What lies between the last of them and the next sample need not be free.
    return SPANS && way_visible(ray, i + others) ? others : others + 1u;
}
