// Squared distances in integers, so that every device finds the same. Twin: src/structure/square.rs.

// In a squared voxel of the finest spacing.
const uint UNIT = 8192u;
// 256 voxels; all that is no nearer is one and the same.
const uint FAR_SQUARED = 65536u * UNIT;

// Square of a way of `count` cells.
uint square_of(uint count, uint weight, uint reach) {
    return count < reach ? count * count * weight : FAR_SQUARED;
}

// Whether `voxels` and the slack of distances lie within the root of `square`: (voxels + 1/512)^2 * UNIT <= square.
bool within(uint voxels, uint square) {
    return voxels == 0u || square > voxels * voxels * UNIT + 32u * voxels;
}

// The largest distance kept.
const uint FAR = 254u;

// Whole voxels within the root of a square, at most FAR.
uint free_voxels(uint square) {
    // A root of f32 is off by less than 1; within() decides.
    uint voxels = min(uint(sqrt(float(square) / float(UNIT))), FAR - 1u) + 1u;
    while (!within(voxels, square)) {
        --voxels;
    }
    return voxels;
}
