//! Damaged meshes of every format and encoding.

use depthleap::read;

use crate::damage::{Numbers, damaged, each};
use crate::mesh_samples::{cube, tetrahedron};
use crate::{INPUTS, is_fit};

/// Bytes changed, put over each other or cut off, where no digits stand.
pub fn flipped(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    const ODD: [u8; 6] = [0, 1, 0x7f, 0x80, 0xfe, 0xff];
    let mut bytes = bytes.to_vec();
    for _ in 0..=numbers.below(4) {
        let at = numbers.below(bytes.len());
        bytes[at] = if numbers.below(2) == 0 { *numbers.pick(&ODD) } else { numbers.below(256) as u8 };
    }
    if numbers.below(8) == 0 {
        bytes.truncate(numbers.below(bytes.len()));
    }
    bytes
}

#[test]
fn meshes_of_every_format() {
    let files = [tetrahedron().files(), cube().files()].concat();
    let read = each(
        10,
        INPUTS,
        |_| {},
        |folder, numbers| {
            let (ending, bytes) = numbers.pick(&files);
            let ending = if numbers.below(16) == 0 { numbers.pick(&files).0 } else { *ending };
            let name = format!("a.{ending}");
            let path = folder.join(&name);
            let bytes = if numbers.below(2) == 0 { damaged(bytes, numbers) } else { flipped(bytes, numbers) };
            std::fs::write(&path, bytes).unwrap();
            match read::mesh(&path) {
                Ok(mesh) => {
                    assert!(!mesh.triangles.is_empty());
                    assert!(mesh.triangles.as_flattened().iter().all(|corner| (*corner as usize) < mesh.corners.len()));
                    assert!(mesh.corners.as_flattened().iter().all(|x| x.is_finite()));
                    true
                }
                Err(error) => {
                    is_fit(&error, &name);
                    false
                }
            }
        },
    );
    assert!((INPUTS / 25..INPUTS - INPUTS / 25).contains(&read), "{read} of {INPUTS} meshes were read");
}

/// Bytes that nobody wrote behind the beginning of a file.
#[test]
fn noise_behind_the_beginnings_of_meshes() {
    let files = tetrahedron().files();
    each(
        11,
        INPUTS / 5,
        |_| {},
        |folder, numbers| {
            let (ending, bytes) = numbers.pick(&files);
            let mut noise = bytes[..numbers.below(bytes.len())].to_vec();
            noise.extend((0..numbers.below(300)).map(|_| numbers.below(256) as u8).collect::<Vec<_>>());
            let name = format!("a.{ending}");
            std::fs::write(folder.join(&name), noise).unwrap();
            read::mesh(&folder.join(&name)).map_err(|error| is_fit(&error, &name)).is_ok()
        },
    );
}
