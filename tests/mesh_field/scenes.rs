//! `[volume] mesh` in scene files, and real meshes.

use std::path::Path;

use depthleap::plan::{notes, plan, warnings};
use depthleap::read;
use depthleap::scene::settings::{Component, Settings, VolumeSettings};
use depthleap::scene::volume::VoxelType;

use super::{BAND, field, triangles};

/// A tetrahedron whose fronts are outside.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn folder(scene: &str) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("meshes")).unwrap();
    std::fs::write(folder.path().join("meshes/a.obj"), TETRAHEDRON).unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, scene).unwrap();
    (folder, file)
}

#[test]
fn a_scene_file_names_a_mesh_beside_it() {
    let text = "[volume]\nmesh = \"meshes/a.obj\"\ndims = [24, 25, 26]\nband = 3\n[surface]\niso = 0\n";
    let (folder, file) = folder(text);
    let settings = read::settings(&file).unwrap();
    assert_eq!(settings.volume.mesh, Some(folder.path().join("meshes/a.obj")));
    let again: Settings = serde_json::from_str(&serde_json::to_string(&settings).unwrap()).unwrap();
    assert_eq!(again, settings);
    let scene = read::scene(&settings).unwrap();
    assert_eq!((scene.field.dims(), scene.field.value_extremes().unwrap()[0]), ([24, 25, 26], -3.0));
    assert_eq!(scene.field.volume.voxels.voxel_type(), VoxelType::F32);
    assert!(notes(&scene)[0].contains("4 triangles of") && notes(&scene)[0].contains("a.obj"), "{:?}", notes(&scene));
    assert_eq!(warnings(&scene, &plan(&scene, None).unwrap()), [""; 0]);
}

#[test]
fn a_mesh_without_an_inside_comes_with_a_warning() {
    let (folder, file) = folder("[volume]\nmesh = \"meshes/a.obj\"\ndims = [24, 24, 24]\n[surface]\niso = 0\n");
    std::fs::write(folder.path().join("meshes/a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let scene = read::scene(&read::settings(&file).unwrap()).unwrap();
    let said = warnings(&scene, &plan(&scene, None).unwrap());
    assert!(said.iter().any(|warning| warning.contains("a.obj") && warning.contains("has no inside")), "{said:?}");
}

#[test]
fn what_has_no_meaning_beside_a_mesh_is_refused() {
    let (folder, _) = folder("");
    let mesh = VolumeSettings { mesh: Some(folder.path().join("meshes/a.obj")), ..VolumeSettings::default() };
    let refused = |volume: VolumeSettings, parts: &[&str]| {
        let error = read::scene(&Settings { volume, ..Settings::default() }).unwrap_err().to_string();
        for part in parts {
            assert!(error.contains(part), "no `{part}` in {error}");
        }
    };
    let path = Some("a.nrrd".into());
    refused(VolumeSettings { path: path.clone(), ..mesh.clone() }, &["both path and mesh", "keep one"]);
    let builtin = Some("shells".to_owned());
    refused(VolumeSettings { builtin: builtin.clone(), ..mesh.clone() }, &["both builtin and mesh"]);
    refused(VolumeSettings { path, builtin, ..mesh.clone() }, &["path, builtin and mesh"]);
    refused(VolumeSettings { voxel_type: Some(VoxelType::U8), ..mesh.clone() }, &["volume.type (--type)", "raw files"]);
    refused(
        VolumeSettings { spacing: Some([1.0; 3]), ..mesh.clone() },
        &["volume.spacing (--spacing)", "leave it out"],
    );
    refused(VolumeSettings { skip: Some(0), ..mesh.clone() }, &["volume.skip (--skip)"]);
    refused(VolumeSettings { frame: Some(1), ..mesh.clone() }, &["a.obj", "--frame", "distances from a mesh"]);
    let component = Some(Component::Luminance);
    refused(VolumeSettings { component, ..mesh.clone() }, &["a.obj", "--component", "luminance"]);
    refused(VolumeSettings { band: Some(0.5), ..mesh.clone() }, &["volume.band (--band)", "is 0.5", "from 1 to 512"]);
    refused(VolumeSettings { dims: Some([5000, 10, 10]), ..mesh.clone() }, &["a.obj", "5000 x 10 x 10", "2048"]);
    refused(VolumeSettings { dims: Some([10, 10, 9]), ..mesh.clone() }, &["a.obj", "at least 10"]);
    refused(VolumeSettings { band: Some(2.0), ..VolumeSettings::default() }, &["volume.band", "without a mesh"]);
    let missing = VolumeSettings { mesh: Some("none/b.ply".into()), ..VolumeSettings::default() };
    refused(missing, &["none/b.ply", "cannot be read", "check the path"]);
    // A mesh where a volume's file is asked for.
    let volume = VolumeSettings { path: mesh.mesh.clone(), mesh: None, ..mesh };
    refused(volume, &["a.obj", "no known volume format", "volume.mesh"]);
}

#[test]
fn wrong_meshes_are_refused_by_their_names() {
    for (text, parts) in [
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", ["a.obj", "no triangles"]),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", ["a.obj", "no triangle with an area"]),
        ("v 0 0 0\nv nan 0 0\nv 2 0 0\nf 1 2 3\n", ["a.obj", ""]),
        ("v 0 0 0\nv 1e30 0 0\nv 2 1 0\nf 1 2 3\n", ["a.obj", "vertex number 2"]),
        ("v 0 0 0\nv 1e-38 0 0\nv 0 1e-38 0\nf 1 2 3\n", ["a.obj", "1e-30"]),
    ] {
        let (folder, file) = folder("[volume]\nmesh = \"meshes/a.obj\"\ndims = [16, 16, 16]\n");
        std::fs::write(folder.path().join("meshes/a.obj"), text).unwrap();
        let error = read::scene(&read::settings(&file).unwrap()).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{text}: {error}");
    }
}

#[test]
fn a_real_mesh_holds_its_volume() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/lucy_decimated.ply");
    if !file.exists() {
        eprintln!("skipped: {} is not there", file.display());
        return;
    }
    let mesh = read::mesh(&file).unwrap();
    let (volume, voxels) = field(&mesh, [64, 64, 128]);
    let middle = triangles(&mesh)[0].corners[0];
    let part = |[a, b, c]: [glam::DVec3; 3]| (a - middle).dot((b - middle).cross(c - middle)) / 6.0;
    let truth: f64 = triangles(&mesh).iter().map(|triangle| part(triangle.corners)).sum();
    // A voxel is as full as its distance from the surface says, from -1/2 to 1/2.
    let full: f64 = voxels.iter().map(|(_, value)| (value + 0.5).clamp(0.0, 1.0)).sum();
    let found = full * volume.spacing[0].powi(3);
    assert!((found / truth - 1.0).abs() < 0.01, "{found} for {truth}");
    assert!(voxels.iter().all(|(_, value)| value.abs() <= BAND));
}
