// Blocks of 8^3 cells with the range of the values in them [KW03 §2.3]. Twin: src/structure/blocks.rs.

// Cells along the side of a block.
const int BLOCK = 8;

// Blocks along each side of a volume of `dims` voxels.
ivec3 block_count(ivec3 dims) {
    return (max(dims - 1, ivec3(1)) + BLOCK - 1) / BLOCK;
}

// Codes (low, high) of a range in a table of 256 x 256, rounded outwards; a value that is a multiple of 1/255
// keeps its code, though f32 may miss it by half a unit.
ivec2 range_codes(vec2 range) {
    const float SLACK = exp2(-22.0);
    float low = floor(range.x * 255.0 * (1.0 + SLACK));
    float high = ceil(range.y * 255.0 * (1.0 - SLACK));
    return ivec2(clamp(vec2(low, high), 0.0, 255.0));
}
