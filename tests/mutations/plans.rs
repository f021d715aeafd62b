//! What is read of damaged scenes can be planned.

use std::path::Path;

use depthleap::method;
use depthleap::part::rows::Method;
use depthleap::plan;
use depthleap::read;

use crate::damage::{damaged, each};
use crate::is_fit;
use crate::text::SCENE;

const HEADER: &[u8] = b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 3 2\nspacings: 1 2 0.5\nencoding: raw\n\n";

/// Reads the scene file and plans it by every method; whether all of it went well.
fn plans(scene: &Path) -> bool {
    let Ok(settings) = read::settings(scene) else { return false };
    let mut scene = match read::scene(&settings) {
        Ok(scene) => scene,
        Err(error) => {
            is_fit(&error, "");
            return false;
        }
    };
    let cast = method::METHODS.into_iter().filter(|method| method.takes_samples());
    cast.map(Method::name).all(|method| {
        scene.settings.method.name = method;
        plan::form(&scene, method::papers_form(method)).and_then(|form| plan::plan(&scene, form)).is_ok()
    })
}

/// Scenes that are planned: each by every method.
const SCENES: usize = 3000;

#[test]
fn of_damaged_scenes_never_panic() {
    let prepare = |folder: &Path| {
        std::fs::write(folder.join("a.nrrd"), [HEADER, &[7; 24]].concat()).unwrap();
        std::fs::write(folder.join("a.raw"), [7; 24]).unwrap();
        let scene = folder.join("a.toml");
        std::fs::write(&scene, SCENE.replace("spacing = [1.0, 2.0, 0.5]", "")).unwrap();
        assert!(plans(&scene), "the undamaged scene has to be right");
    };
    let raw = SCENE.replace("\"a.nrrd\"", "\"a.raw\"\ndims = [4, 3, 2]\ntype = \"u8\"");
    let read = each(1, SCENES, prepare, |folder, numbers| {
        let scene = folder.join("a.toml");
        std::fs::write(&scene, damaged(raw.as_bytes(), numbers)).unwrap();
        plans(&scene)
    });
    // Not all of them damage: the plans are reached too.
    assert!((SCENES / 30..SCENES - SCENES / 30).contains(&read), "{read} of {SCENES} scenes were read");
}
