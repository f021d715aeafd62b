// Distances to what shows, and how many samples of a ray are free by them [Thesis §5.3]. Twin: src/twin/near_neighbor.rs.
// Needs frame.glsl, double_float.glsl, samples.glsl and free.glsl.

// Of each cell a byte, or eight bytes in two words, one for each octant: 0 where the cell is interesting, else one more
// than the voxels of the finest spacing that a ray may go from anywhere in the cell.
layout(set = 0, binding = 10) uniform usampler3D nearest_distance;

// Side of a cell of the structure, in voxels.
layout(constant_id = 7) const int CELL = 1;
// The structure tells octants apart.
layout(constant_id = 8) const bool OCTANTS = false;
// A sample stands for all values up to the next one (preintegrated.glsl).
layout(constant_id = 12) const bool SPANS = false;

// The largest distance there is, and the longest way inside a cell that is counted, in voxels.
const float FAR = 254.0;

// The byte of the structure's cell `box`.
uint byte_of(Ray ray, ivec3 box) {
    uvec2 texel = texelFetch(nearest_distance, box, 0).rg;
    if (!OCTANTS) {
        return texel.x;
    }
    uvec3 down = uvec3(lessThan(ray.step_vector, vec3(0.0)));
    return bitfieldExtract(down.z == 0u ? texel.x : texel.y, int(8u * (down.x + 2u * down.y)), 8);
}

// Samples from `i` on that show nothing.
uint free_from(Ray ray, uint i) {
    Place place = place_of(ray, i);
    ivec3 box = cell_of(place) / CELL;
    uint byte = byte_of(ray, box);
    if (byte == 0u) {
        return 0u;
    }
    float inside = min(steps_inside(ray, place, box, CELL) * frame.step_voxels, FAR);
    uint free = free_samples(inside + float(byte - 1u), stride_of(ray));
    // What lies between the last free sample and the next one need not be free.
    return SPANS ? free - 1u : free;
}
