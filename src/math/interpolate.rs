//! Trilinear and nearest interpolation with clamp to edge on a grid whose values sit at voxel centres.

use glam::DVec3;

/// The two voxels that bracket `coordinate` (voxel space, centres at i + 0.5) and the weight of the second.
pub fn bracket(coordinate: f64, voxels: usize) -> (usize, usize, f64) {
    let shifted = coordinate - 0.5;
    let below = shifted.floor();
    let last = voxels as f64 - 1.0;
    (below.clamp(0.0, last) as usize, (below + 1.0).clamp(0.0, last) as usize, shifted - below)
}

/// Value at `voxel` (voxel space) of a grid of `dims` voxels, x fastest.
pub fn trilinear(values: &[f32], dims: [usize; 3], voxel: DVec3) -> f64 {
    let (x0, x1, wx) = bracket(voxel.x, dims[0]);
    let (y0, y1, wy) = bracket(voxel.y, dims[1]);
    let (z0, z1, wz) = bracket(voxel.z, dims[2]);
    let at = |x: usize, y: usize, z: usize| f64::from(values[(z * dims[1] + y) * dims[0] + x]);
    let along_x = |y: usize, z: usize| mix(at(x0, y, z), at(x1, y, z), wx);
    let along_y = |z: usize| mix(along_x(y0, z), along_x(y1, z), wy);
    mix(along_y(z0), along_y(z1), wz)
}

/// Value of the voxel whose centre is nearest to `voxel` (voxel space), the later one of two that are as near.
pub fn nearest(values: &[f32], dims: [usize; 3], voxel: DVec3) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| voxel[axis].floor().clamp(0.0, dims[axis] as f64 - 1.0) as usize);
    f64::from(values[(z * dims[1] + y) * dims[0] + x])
}

/// `a + weight * (b - a)`: exactly `a` where both are equal, so that a constant neighbourhood stays constant.
pub fn mix(a: f64, b: f64, weight: f64) -> f64 {
    weight.mul_add(b - a, a)
}
