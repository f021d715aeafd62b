// A part of a structure's build: the invocations `first` to `end` of a step, so that a large volume is built in many
// short dispatches, and what the step knows of the grid. The Rust side is src/shared/slice.rs.

layout(local_size_x = 64) in;

layout(push_constant) uniform Slice {
    uint first;
    uint end;
    // Cells of the grid along x, y and z, and their side in cells of the volume.
    uint cells_x;
    uint cells_y;
    uint cells_z;
    uint cell;
    // The columns a scan runs along: element i of column c is at (c / inner) * outer + c % inner + i * stride.
    uint inner;
    uint outer;
    uint stride;
    // Square of a cell's side along the scan's axis, in units of 1 / UNIT squared voxels, and the cells from which on it is
    // FAR_SQUARED.
    uint weight;
    uint reach;
    // The octant distances are for: bit a set where rays go down on axis a.
    uint octant;
    // Vertices of a shell, its level among the texture's values, and what values that are not below it are at least.
    uint corners;
    float level;
    float threshold;
    // Sides of a voxel in volume space.
    float voxel_x;
    float voxel_y;
    float voxel_z;
} slice;

// What this invocation is to make.
uint invocation() {
    return slice.first + gl_GlobalInvocationID.x;
}

// Words of a row of `count` cells, 32 of them in a word.
uint words(uint count) {
    return (count + 31u) / 32u;
}
