//! Damaged meshes of cells, as text and as bytes.

use depthleap::read;
use depthleap::scene::settings::Settings;

use crate::cell_samples::{FORMS, RECTILINEAR, STRUCTURED, TEXT, bytes, xml};
use crate::damage::{damaged, each};
use crate::meshes::flipped;
use crate::{INPUTS, is_fit};

#[test]
fn meshes_of_cells() {
    let legacy = [TEXT.as_bytes().to_vec(), bytes(), STRUCTURED.as_bytes().to_vec(), RECTILINEAR.as_bytes().to_vec()];
    let files: Vec<Vec<u8>> = legacy.into_iter().chain(FORMS.map(xml)).collect();
    let read = each(
        12,
        INPUTS,
        |_| {},
        |folder, numbers| {
            let file = numbers.pick(&files);
            let path = folder.join("a.vtk");
            let bytes = if numbers.below(2) == 0 { damaged(file, numbers) } else { flipped(file, numbers) };
            std::fs::write(&path, bytes).unwrap();
            let mut settings = Settings::default();
            settings.volume.path = Some(path);
            match read::scene(&settings) {
                Ok(scene) => {
                    let mesh = scene.tetrahedra.expect("a mesh");
                    let count = mesh.points.len() as u32;
                    assert!(mesh.cells.iter().flatten().all(|corner| *corner < count));
                    assert!(mesh.values.iter().chain(mesh.points.as_flattened()).all(|x| x.is_finite()));
                    assert!(mesh.unit > 0.0 && scene.field.extent().max_element() <= 1.0);
                    true
                }
                Err(error) => {
                    let of_file = error.input.contains("a.vtk");
                    if of_file {
                        is_fit(&error, "a.vtk");
                    } else {
                        is_fit(&error, "volume.");
                    }
                    false
                }
            }
        },
    );
    assert!((INPUTS / 25..INPUTS - INPUTS / 25).contains(&read), "{read} of {INPUTS} meshes were read");
}
