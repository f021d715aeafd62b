//! Clip geometry: which parts of a ray it keeps, by closed forms, and what is said of it.

use depthleap::feature::layers::first_section;
use depthleap::method;
use depthleap::part::Group;
use depthleap::part::rows::Context;
use depthleap::plan::{plan, warnings};
use depthleap::read;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{ClipSettings, MeshSettings, Settings};
use depthleap::scene::{Camera, Scene};
use depthleap::truth::exact::ExactIntegrator;
use glam::DVec3;

const SIZE: [u32; 2] = [40, 30];

fn settings(clips: Vec<ClipSettings>) -> Settings {
    let mut settings = Settings { clips, ..Settings::default() };
    settings.volume.builtin = Some("constant:16".to_owned());
    settings.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.2]]);
    settings.image.size = SIZE;
    settings
}

fn scene(clips: Vec<ClipSettings>) -> Scene {
    read::scene(&settings(clips)).unwrap()
}

fn clip(builtin: &str, keep: Keep) -> ClipSettings {
    ClipSettings { builtin: Some(builtin.to_owned()), scale: 0.8, keep, ..ClipSettings::default() }
}

/// The optical depth of every pixel, by the exact integral.
fn depths(scene: &Scene) -> Vec<f64> {
    let rays = scene.camera.rays(SIZE).unwrap();
    let picture = ExactIntegrator::of(scene).picture(&rays, SIZE);
    picture.iter().map(|pixel| -(-pixel[3]).ln_1p()).collect()
}

#[test]
fn a_sphere_keeps_its_chords() {
    let of = |keep| depths(&scene(vec![clip("sphere:500", keep)]));
    let (inside, outside) = (of(Keep::Inside), of(Keep::Outside));
    let all = scene(Vec::new());
    let (whole, rays) = (depths(&all), all.camera.rays(SIZE).unwrap());
    // A voxel is 1/16 of the volume's side.
    let density = -16.0 * (-0.2f64).ln_1p();
    let mut longest = 0.0f64;
    for (i, whole) in whole.iter().enumerate() {
        assert!((inside[i] + outside[i] - whole).abs() < 1e-9, "pixel {i}: the parts are not the whole");
        let direction = rays.of(i as u32 % SIZE[0], i as u32 / SIZE[0]).direction.normalize();
        let nearest = rays.origin - rays.origin.dot(direction) * direction;
        let square = 0.16 - nearest.length_squared();
        let chord = 2.0 * square.max(0.0).sqrt();
        // Facets lie up to 8e-6 inside of the sphere: that shortens a chord the more the shorter it is.
        if chord == 0.0 || chord > 0.2 {
            assert!((inside[i] - density * chord).abs() < 2e-3, "pixel {i}: {} and {chord}", inside[i]);
        }
        longest = longest.max(chord);
    }
    assert!(longest > 0.79, "{longest}");
}

#[test]
fn what_every_mesh_keeps_is_drawn() {
    let hole = ClipSettings { scale: 0.5, ..clip("sphere:200", Keep::Outside) };
    let shell = depths(&scene(vec![clip("sphere:200", Keep::Inside), hole.clone()]));
    let ball = depths(&scene(vec![clip("sphere:200", Keep::Inside)]));
    let small = depths(&scene(vec![ClipSettings { keep: Keep::Inside, ..hole }]));
    for i in 0..shell.len() {
        assert!((shell[i] - (ball[i] - small[i])).abs() < 1e-9, "pixel {i}");
    }
}

#[test]
fn faces_that_cut_each_other_do_not_turn_inside_out() {
    // The teapot's spout and handle reach into its belly, as a torus and a sphere in one file would.
    let (inside, outside) = (scene(vec![clip("teapot", Keep::Inside)]), scene(vec![clip("teapot", Keep::Outside)]));
    let (whole, inside, outside) = (depths(&scene(Vec::new())), depths(&inside), depths(&outside));
    for i in 0..whole.len() {
        assert!((inside[i] + outside[i] - whole[i]).abs() < 1e-9, "pixel {i}");
    }
    let middle = (SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize;
    assert!(inside[middle] > 0.4 * whole[middle], "the belly is missing: {} of {}", inside[middle], whole[middle]);
}

#[test]
fn an_eye_inside_is_inside() {
    let eye = Camera { eye: DVec3::new(0.05, 0.0, 0.1), ..(&Settings::default().camera).into() };
    let seen = |clips| depths(&scene(clips).seen_by(eye));
    let (whole, inside, outside) =
        (seen(Vec::new()), seen(vec![clip("sphere:200", Keep::Inside)]), seen(vec![clip("sphere:200", Keep::Outside)]));
    for i in 0..whole.len() {
        assert!(inside[i] > 0.0 && inside[i] < whole[i], "pixel {i}");
        assert!((inside[i] + outside[i] - whole[i]).abs() < 1e-9, "pixel {i}");
    }
}

#[test]
fn the_thesis_cuts_in_front_of_the_first_surface_and_hides_meshes_there() {
    let by = |keep| scene(vec![clip("sphere:200", keep)]);
    let (behind, inside) = (by(Keep::Thesis), by(Keep::Inside));
    let (first, within, whole) = (depths(&behind), depths(&inside), depths(&scene(Vec::new())));
    let rays = behind.camera.rays(SIZE).unwrap();
    let uncovered = behind.polygons.uncovered(&rays, SIZE, |ray| behind.interval(ray, rays.near).is_some());
    let half = ClipSettings { plane: Some([1.0, 0.0, 0.0, 0.0]), ..ClipSettings::default() };
    let cut = scene(vec![clip("sphere:200", Keep::Thesis), half]);
    let of_half = cut.polygons.uncovered(&rays, SIZE, |ray| cut.interval(ray, rays.near).is_some());
    assert!(0 < of_half && 2 * of_half < uncovered + 2 * SIZE[1] as usize, "{of_half} of {uncovered} pixels");
    let mut missed = 0;
    for i in 0..whole.len() {
        let covered = within[i] > 0.0;
        missed += usize::from(!covered && whole[i] > 0.0);
        assert_eq!(first[i] > 0.0, covered, "pixel {i}");
        assert!(first[i] >= within[i] - 1e-12 && first[i] <= whole[i], "pixel {i}");
    }
    assert!(missed > 20 && uncovered == missed, "{uncovered} pixels are said to be uncovered, {missed} are");

    let mut settings = settings(vec![clip("sphere:200", Keep::Thesis)]);
    let mesh = |z: f64| MeshSettings {
        builtin: Some("box".to_owned()),
        scale: 0.1,
        translate: [0.0, 0.0, z],
        ..MeshSettings::default()
    };
    settings.meshes = vec![mesh(0.6), mesh(0.0)];
    let scene = read::scene(&settings).unwrap();
    let middle = scene.polygons.divided(&scene.camera.rays([41, 31]).unwrap(), [20, 15], 4);
    assert_eq!(middle.surfaces.len(), 1, "{middle:?}");
    assert!((middle.surfaces[0].depth - (scene.camera.eye.length() - 0.05)).abs() < 1e-6, "{middle:?}");
}

#[test]
fn frames_have_what_clip_geometry_needs_and_no_more() {
    let planned = |clips: Vec<ClipSettings>, eye: [f64; 3]| {
        let mut settings = settings(clips);
        (settings.camera.eye, settings.method.name) = (eye, method::NN_OMNI.name());
        let scene = read::scene(&settings).unwrap();
        let form = method::NN_OMNI.papers;
        let plan = plan(&scene, form).unwrap();
        let context = Context::new(&scene, &plan.view, plan.method, form, plan.passes);
        let names: Vec<String> = plan.steps.iter().map(|step| step.name.clone()).collect();
        (names, first_section(&context), plan)
    };
    let (from, within) = ([0.0, 0.1, 2.0], [0.0, 0.1, 0.2]);
    let has = |names: &[String], name: &str| names.iter().any(|one| one.split(' ').next() == Some(name));

    let (names, first, plan) = planned(vec![clip("sphere", Keep::Inside)], from);
    assert!(!has(&names, "clip_begin") && first == 1, "{names:?}");
    assert!(names.iter().all(|name| !name.starts_with("main_pass") || name.contains("behind layer")), "{names:?}");
    assert!(plan.steps.iter().all(|step| step.group != Group::Blend), "there are no colours to blend");
    assert!(plan.resources().iter().all(|resource| resource.name() != "layer_color"));

    let (names, first, _) = planned(vec![clip("sphere", Keep::Outside)], from);
    assert!(!has(&names, "clip_begin") && first == 0, "{names:?}");
    let (names, first, _) = planned(vec![clip("sphere", Keep::Outside)], within);
    assert!(has(&names, "clip_winding") && has(&names, "clip_begin") && first == 0, "{names:?}");
    let (names, first, _) = planned(vec![clip("sphere", Keep::Thesis)], from);
    assert!(has(&names, "clip") && !has(&names, "peel") && first == 0, "{names:?}");
}

#[test]
fn open_meshes_are_said_to_be_open() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("quad.obj");
    std::fs::write(&file, "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n").unwrap();
    let quad = |keep| ClipSettings { path: Some(file.clone()), keep, ..ClipSettings::default() };
    let scene = scene(vec![quad(Keep::Inside)]);
    let said = warnings(&scene, &plan(&scene, None).unwrap());
    assert!(said.iter().any(|warning| warning.contains("quad.obj is open at 4 edges")), "{said:?}");
    // Its front is towards the eye: what is behind is inside, and nothing else.
    let (behind, whole) = (depths(&scene), depths(&self::scene(Vec::new())));
    let middle = (SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize;
    assert!((behind[middle] / whole[middle] - 0.5).abs() < 0.02, "{} of {}", behind[middle], whole[middle]);
    // The same face seen from behind: what is in front is inside.
    let turned = self::scene(vec![ClipSettings { rotate: [0.0, 180.0, 0.0], ..quad(Keep::Inside) }]);
    assert!((depths(&turned)[middle] / whole[middle] - 0.5).abs() < 0.02);
    let closed = self::scene(vec![clip("torus", Keep::Inside)]);
    assert_eq!(closed.polygons.clips()[0].open_edges, 0);
}

#[test]
fn closed_meshes_that_are_turned_inwards_are_turned() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("inwards.obj");
    // A tetrahedron whose faces go round the other way.
    std::fs::write(&file, "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n").unwrap();
    let wrong = scene(vec![ClipSettings { path: Some(file.clone()), ..ClipSettings::default() }]);
    std::fs::write(&file, "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n").unwrap();
    let right = scene(vec![ClipSettings { path: Some(file), ..ClipSettings::default() }]);
    assert!(depths(&right).iter().any(|depth| *depth > 0.1), "the tetrahedron is in sight");
    assert_eq!(depths(&wrong), depths(&right));
}

#[test]
fn clip_geometry_without_an_area_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("line.obj");
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0.5 0 0\nf 1 2 3\n").unwrap();
    let line = ClipSettings { path: Some(file), ..ClipSettings::default() };
    let error = read::scene(&settings(vec![line])).unwrap_err().to_string();
    assert!(error.contains("line.obj") && error.contains("no triangle with an area"), "{error}");
}

#[test]
fn wrong_clip_geometry_is_refused_by_its_key() {
    let cases: [(Vec<ClipSettings>, &str); 5] = [
        (vec![ClipSettings { builtin: None, ..clip("box", Keep::Inside) }], "clip.mesh"),
        (vec![ClipSettings { scale: -1.0, ..clip("box", Keep::Inside) }], "clip.scale"),
        (vec![ClipSettings { transform: Some(vec![[0.0; 4]; 3]), ..clip("box", Keep::Inside) }], "determinant is 0"),
        (vec![clip("box", Keep::Inside), clip("box", Keep::Thesis)], "give it in all of them"),
        (vec![clip("box", Keep::Inside); 5], "keep them to 4"),
    ];
    for (clips, says) in cases {
        let error = read::scene(&settings(clips)).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
    let mut projected = settings(vec![clip("box", Keep::Inside)]);
    projected.projection.kind = depthleap::projection::MIP.name();
    let error = plan(&read::scene(&projected).unwrap(), None).unwrap_err().to_string();
    assert!(error.contains("leaves parts"), "{error}");
}

#[test]
fn scene_files_have_clip_geometry() {
    let text = "[[clip]]\nbuiltin = \"sphere\"\nkeep = \"outside\"\nscale = 0.5\n";
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text).unwrap();
    let found = read::settings(&file).unwrap();
    assert_eq!(found.clips, [ClipSettings { scale: 0.5, ..clip("sphere", Keep::Outside) }]);
    let again: Settings = serde_json::from_str(&serde_json::to_string(&found).unwrap()).unwrap();
    assert_eq!(again, found);
    std::fs::write(&file, "[[clip]]\nmesh = \"tool.ply\"\n").unwrap();
    assert_eq!(read::settings(&file).unwrap().clips[0].path, Some(folder.path().join("tool.ply")));
    std::fs::write(&file, "[[clip]]\nbuiltin = \"sphere\"\nkeep = \"left\"\n").unwrap();
    let error = read::settings(&file).unwrap_err().to_string();
    assert!(error.contains("left") && error.contains("inside"), "{error}");
}
