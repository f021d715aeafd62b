use crate::scene::{Field, TransferFunction};
pub fn interesting(field: &Field, transfer: &TransferFunction) -> Vec<bool> {
    let [nx, ny, nz] = field.cells();
    (0..nx * ny * nz).map(|i| {
        let c = field.corners([i % nx, i / nx % ny, i / (nx * ny)]).map(|v| f64::from(field.values[v]));
        let lo = c.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = c.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        transfer.visible(lo, hi)
    }).collect()
}
