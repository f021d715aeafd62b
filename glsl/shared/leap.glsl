// How many samples of a ray are free from one on, for a loop that leaps over them: by distances, or LEAP_BLOCKS: by blocks.
// Twin: src/twin/single_pass.rs. Distances: distance.glsl says it. Needs for blocks visible_block.glsl.

#ifdef LEAP_BLOCKS
// Samples from `i` on that show nothing: those that lie in the same block, where that is empty.
uint free_from(Ray ray, uint i) {
    Place place = place_at(ray, steps_to(i));
    ivec3 block = cell_of(place) / BLOCK;
    if (block_visible(block)) {
        return 0u;
    }
    uint others = samples_in_block(ray, place, block);
    // What lies between the last of them and the next sample need not be free.
    return SPANS && way_visible(ray, i + others) ? others : others + 1u;
}
#endif
