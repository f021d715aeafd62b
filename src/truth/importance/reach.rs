//! The most among the cells in reach of each, along the axes one after the other.

use rayon::prelude::*;

use super::code::Code;

/// The most among all cells no farther off than `reach` along each axis.
pub fn most_within(codes: &[Code], cells: [usize; 3], reach: [usize; 3]) -> Vec<Code> {
    let bytes: Vec<u8> = codes.par_iter().map(|code| code.0).collect();
    within(bytes, cells, reach).into_par_iter().map(Code).collect()
}

/// The least among all cells no farther off than `reach` along each axis.
pub fn least_within(codes: &[Code], cells: [usize; 3], reach: [usize; 3]) -> Vec<Code> {
    let bytes: Vec<u8> = codes.par_iter().map(|code| !code.0).collect();
    within(bytes, cells, reach).into_par_iter().map(|byte| Code(!byte)).collect()
}

/// 1 where any cell no farther off than `reach` along each axis has it.
pub fn any_within(marks: &[u8], cells: [usize; 3], reach: [usize; 3]) -> Vec<u8> {
    within(marks.to_vec(), cells, reach)
}

fn within(mut bytes: Vec<u8>, [nx, ny, nz]: [usize; 3], reach: [usize; 3]) -> Vec<u8> {
    let plane = (nx * ny).max(1);
    bytes.par_chunks_mut(plane).for_each(|plane| {
        plane.chunks_mut(nx.max(1)).for_each(|row| spread(row, 1, reach[0]));
        spread(plane, nx, reach[1]);
    });
    // Along z rows of all planes, which lie apart.
    let rows: Vec<Vec<u8>> = (0..ny)
        .into_par_iter()
        .map(|y| {
            let mut rows: Vec<u8> = (0..nz).flat_map(|z| bytes[z * plane + y * nx..][..nx].iter().copied()).collect();
            spread(&mut rows, nx, reach[2]);
            rows
        })
        .collect();
    bytes.par_chunks_mut(plane).enumerate().for_each(|(z, plane)| {
        for (y, rows) in rows.iter().enumerate() {
            plane[y * nx..][..nx].copy_from_slice(&rows[z * nx..][..nx]);
        }
    });
    bytes
}

/// Puts the most of the 2 `reach` + 1 items around each in its place, byte by byte; items are so many bytes `long`.
///
/// Of windows that are twice as wide each time, two overlapping ones make up any width.
fn spread(bytes: &mut [u8], long: usize, reach: usize) {
    let reach = reach.min(bytes.len() / long.max(1));
    if reach == 0 {
        return;
    }
    // As many zeros on each side as are in reach.
    let mut wider = vec![0u8; bytes.len() + 2 * reach * long];
    wider[reach * long..][..bytes.len()].copy_from_slice(bytes);
    let mut before = wider.clone();
    let width = 2 * reach + 1;
    let mut have = 1;
    while have < width {
        let by = have.min(width - have);
        before.copy_from_slice(&wider);
        wider.iter_mut().zip(&before[by * long..]).for_each(|(most, other)| *most = (*most).max(*other));
        have += by;
    }
    bytes.copy_from_slice(&wider[..bytes.len()]);
}
