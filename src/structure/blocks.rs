use crate::scene::{Field, TransferFunction};
pub const BLOCK: usize = 8;
pub fn visibility_table(t: &TransferFunction) -> Vec<u8> {
    (0..65536).map(|i| { let (h, l) = (i / 256, i % 256); u8::from(l <= h && t.visible(l as f64 / 255.0, h as f64 / 255.0)) }).collect()
}
#[derive(Clone, Debug)]
pub struct Blocks { dims: [usize; 3], visible: Vec<bool> }
impl Blocks {
    pub fn dims(field: &Field) -> [usize; 3] { field.cells().map(|n| n.div_ceil(BLOCK)) }
    pub fn build(field: &Field, transfer: &TransferFunction) -> Self {
        let dims = Self::dims(field);
        let cells = super::cells::interesting(field, transfer);
        let mut visible = vec![false; dims.iter().product()];
        let [nx, ny, _] = field.cells();
        for (i, c) in cells.iter().enumerate() { if *c { let (x, y, z) = (i % nx / 8, i / nx % ny / 8, i / (nx * ny) / 8); visible[(z * dims[1] + y) * dims[0] + x] = true; } }
        Self { dims, visible }
    }
    pub fn visible(&self, [x, y, z]: [usize; 3]) -> bool { self.visible[(z / 8 * self.dims[1] + y / 8) * self.dims[0] + x / 8] }
    pub fn bytes(&self) -> u64 { self.visible.len() as u64 * 8 }
}
