use crate::scene::{Field, TransferFunction};
#[derive(Clone, Debug)]
pub struct DistanceField { pub cells: [usize; 3], pub distances: Vec<u8> }
pub fn omni(cells: [usize; 3], spacing: glam::DVec3, interesting: &[bool]) -> DistanceField {
    let [nx, ny, _] = cells;
    let at = |i: usize| [i % nx, i / nx % ny, i / (nx * ny)];
    let set: Vec<[usize; 3]> = (0..interesting.len()).filter(|&i| interesting[i]).map(at).collect();
    use rayon::prelude::*;
    let distances = (0..interesting.len()).into_par_iter().map(|i| {
        let c = at(i);
        set.iter().map(|s| { let mut d2 = 0.0; for a in 0..3 { let d = (s[a].abs_diff(c[a])).saturating_sub(1) as f64 * spacing[a]; d2 += d * d; } d2 }).fold(f64::INFINITY, f64::min).sqrt().floor().min(255.0) as u8
    }).collect();
    DistanceField { cells, distances }
}
pub fn build(field: &Field, transfer: &TransferFunction) -> DistanceField {
    omni(field.cells(), field.voxel() / field.finest(), &super::cells::interesting(field, transfer))
}
impl DistanceField {
    pub fn at(&self, [x, y, z]: [usize; 3]) -> u8 { self.distances[(z * self.cells[1] + y) * self.cells[0] + x] }
    pub fn bytes(&self) -> u64 { self.distances.len() as u64 }
}
