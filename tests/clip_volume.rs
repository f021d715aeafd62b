//! Clipping by another volume's iso-surface, held against closed forms, clip planes and the exact integral. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;

use std::path::Path;

use depthleap::feature::CLIP_VOLUME;
use depthleap::method::{METHODS, RC_ERT, SINGLE_PASS, SINGLE_PASS_OMNI};
use depthleap::part::rows::Context;
use depthleap::plan::{self, plan};
use depthleap::projection::{AVERAGE, MIP};
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::builtin;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{
    Classification, ClipSettings, Filter, LightSettings, Refine, Settings, Shows, SurfaceLevel, Translucency,
    VolumeTexture,
};
use depthleap::truth::exact::ExactIntegrator;
use drawn::drawn;
use glam::DVec3;

type Change = fn(&mut Settings);

fn settings(volume: &str, clip: ClipSettings) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.volume.texture = VolumeTexture::R32f;
    settings.image.size = [72, 60];
    settings.camera.eye = [0.3, 0.5, 1.6];
    settings.sampling.filter = Filter::Exact;
    settings.sampling.termination = 1.0;
    settings.method.name = SINGLE_PASS.name();
    settings.clips = vec![clip];
    settings
}

/// The scene, with surfaces in the same light whatever their normals, of which the interpolant has its own idea.
fn scene(settings: &Settings) -> Scene {
    let mut settings = settings.clone();
    if settings.surface.is_asked() {
        let direction = Some([0.0, 0.0, 1.0]);
        settings.lights =
            vec![LightSettings { direction, ambient: 1.0, diffuse: 0.0, specular: 0.0, ..LightSettings::default() }];
    }
    read::scene(&settings).unwrap()
}

/// By a built-in volume.
fn clip(volume: &str, iso: f64, keep: Keep) -> ClipSettings {
    ClipSettings { builtin: Some(volume.to_owned()), iso: Some(iso), keep, ..ClipSettings::default() }
}

/// A ball about the centre with that radius, in volume units.
fn ball(radius: f64, keep: Keep) -> ClipSettings {
    clip("gaussian:96", builtin::find("gaussian").unwrap().value(2.0 * radius * DVec3::X), keep)
}

/// Standard deviation of the round Gaussian, on [-1, 1]^3.
const SIGMA: f64 = 0.3;

/// How far the interpolant of a ball is from it.
const BALL_ROUNDING: f64 = 2e-4;

/// What is above a plane across x, as a clip volume and as a clip plane.
fn above(x: f64) -> [ClipSettings; 2] {
    let plane = ClipSettings { plane: Some([1.0, 0.0, 0.0, -x]), ..ClipSettings::default() };
    [clip("linear:24x3x5", 0.5 + x, Keep::Inside), plane].map(|clip| match clip.plane {
        // Of a box that is a cube, in place of one of 24 x 3 x 5 voxels.
        None => ClipSettings {
            transform: Some(vec![[1.0, 0.0, 0.0, 0.0], [0.0, 8.0, 0.0, 0.0], [0.0, 0.0, 24.0 / 5.0, 0.0]]),
            ..clip
        },
        Some(_) => clip,
    })
}

/// How long each ray of a scene goes within a ball about the centre.
fn chords(scene: &Scene, radius: f64) -> Vec<f64> {
    let plan = plan(scene, None).unwrap();
    let [width, height] = plan.view.size;
    let chord = |i: u32| {
        let (eye, direction) = (plan.view.rays.origin, plan.view.rays.of(i % width, i / width).direction.normalize());
        let middle = -eye.dot(direction);
        let apart = (eye + middle * direction).length();
        2.0 * (radius * radius - apart * apart).max(0.0).sqrt()
    };
    (0..width * height).map(chord).collect()
}

/// A ball cut out of a medium that is the same everywhere lets through what Beer's law says of its chords.
#[test]
fn ball_of_a_constant_medium_is_beers_law_of_its_chords() {
    const RADIUS: f64 = 0.33;
    const OPACITY: f64 = 0.3;
    const SIDE: f64 = 16.0;
    let mut settings = settings("constant:16", ball(RADIUS, Keep::Inside));
    settings.transfer.points = Some(vec![[0.5, 0.9, 0.5, 0.1, OPACITY]]);
    settings.sampling.step = 0.25;
    let scene = scene(&settings);
    let opacity = |chord: f64| 1.0 - (1.0 - OPACITY).powf(SIDE * chord);
    let (plan, frame) = drawn(&scene);
    let exact = ExactIntegrator::of(&scene).picture(&plan.view.rays, plan.view.size);
    let [less, more] = [-BALL_ROUNDING, BALL_ROUNDING].map(|by| chords(&scene, RADIUS + by));
    // A sample too much or too few at each end.
    let step = settings.sampling.step / SIDE;
    let mut within = 0;
    for (i, (exact, sampled)) in exact.iter().zip(&frame.pixels).enumerate() {
        let between = opacity(less[i]) - 1e-9..=opacity(more[i]) + 1e-9;
        assert!(between.contains(&exact[3]), "pixel {i}: {exact:?}, {between:?} expected");
        assert!((exact[0] - 0.9 * exact[3]).abs() < 1e-9, "{exact:?}");
        let between = opacity(less[i] - 2.0 * step) - 1e-9..=opacity(more[i] + 2.0 * step) + 1e-9;
        assert!(between.contains(&sampled[3]), "pixel {i}: {sampled:?}, {between:?} expected");
        within += usize::from(less[i] > 0.0);
    }
    assert!(within > 100, "{within}");
}

/// What is not in the ball is the rest of the ray: of a medium that is the same everywhere the two let through what all of it does.
#[test]
fn inside_and_outside_are_the_whole() {
    let parts = [Keep::Inside, Keep::Outside].map(|keep| {
        let mut settings = settings("constant:16", ball(0.33, keep));
        settings.transfer.points = Some(vec![[0.5, 0.9, 0.5, 0.1, 0.1]]);
        scene(&settings)
    });
    let mut whole = parts[0].clone();
    whole.clip_volume = None;
    let [inside, outside, whole] = [&parts[0], &parts[1], &whole].map(|scene| drawn(scene).1.pixels);
    for ((inside, outside), whole) in inside.iter().zip(&outside).zip(&whole) {
        let clear = (1.0 - inside[3]) * (1.0 - outside[3]);
        assert!((clear - (1.0 - whole[3])).abs() < 1e-9, "{inside:?} {outside:?} {whole:?}");
    }
}

/// Beyond a clip volume's box nothing is inside.
#[test]
fn what_is_beyond_the_box_is_outside() {
    // All of its values have reached the level: a cube of half the volume's side.
    let cube = |keep| ClipSettings { scale: 0.5, ..clip("constant:3", 0.5, keep) };
    let points = vec![[0.5, 0.9, 0.5, 0.1, 0.3]];
    let [inside, outside] = [Keep::Inside, Keep::Outside].map(|keep| {
        let mut settings = settings("constant:16", cube(keep));
        settings.transfer.points = Some(points.clone());
        let scene = scene(&settings);
        let exact = ExactIntegrator::of(&scene);
        exact
            .kept_parts(DVec3::new(-0.5, 0.01, 0.02), DVec3::X, 1.0)
            .into_iter()
            .map(|part| (part.to, part.kept))
            .collect::<Vec<_>>()
    });
    let near = |found: &[(f64, bool)], kept: bool| {
        let rule = [(0.25, !kept), (0.75, kept), (1.0, !kept)];
        // The faces are as wide as rounding may move a place.
        found.len() == 3 && found.iter().zip(rule).all(|(a, b)| (a.0 - b.0).abs() < 1e-3 && a.1 == b.1)
    };
    assert!(near(&inside, true) && near(&outside, false), "{inside:?} {outside:?}");
}

/// An opaque surface, of which pixels show the place.
fn opaque(settings: &mut Settings, refine: Refine) {
    (settings.surface.iso, settings.surface.refine, settings.surface.shows) = (Some(0.3), refine, Shows::Position);
}

/// How many pixels of two pictures differ by more than so much, and how many are not empty.
fn differing(a: &[[f64; 4]], b: &[[f64; 4]], most: f64) -> (usize, usize) {
    let apart = |(a, b): (&[f64; 4], &[f64; 4])| (0..4).any(|c| (a[c] - b[c]).abs() > most);
    (a.iter().zip(b).filter(|pair| apart(*pair)).count(), a.iter().filter(|pixel| pixel[3] > 0.0).count())
}

/// A ramp of values clips as the plane does at which it has its level. Colours differ by a sample at the cut; surfaces and caps are in
/// the same places, but for those that run along the cut.
#[test]
fn ramp_clips_as_a_plane_does() {
    let cases: [(&str, f64, Change); 4] = [
        ("colours", 0.04, |s| {
            s.transfer.points = Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.3]]);
            s.sampling.step = 0.1;
        }),
        ("an opaque surface", 2e-3, |s| opaque(s, Refine::Exact)),
        ("an opaque surface, linearly", 2e-2, |s| opaque(s, Refine::Linear)),
        ("transparent surfaces", 2e-3, |s| {
            s.surface.levels = [0.3, 0.6].map(|iso| SurfaceLevel { iso, color: None, opacity: 0.5 }).into();
            s.surface.refine = Refine::Exact;
        }),
    ];
    for (name, most, change) in cases {
        let [volume, plane] = above(0.07).map(|clip| {
            let mut settings = settings("gaussian:20", clip);
            change(&mut settings);
            drawn(&scene(&settings)).1.pixels
        });
        let (wrong, all) = differing(&plane, &volume, most);
        println!("{name}: {wrong} of {all} pixels differ by more than {most}");
        assert!(all > 100 && wrong * 50 <= all, "{name}: {wrong} of {all}");
        // The check can fail.
        let whole = settings("gaussian:20", clip("constant:2", 0.5, Keep::Inside));
        let mut whole = Settings { clips: Vec::new(), ..whole };
        change(&mut whole);
        assert!(differing(&plane, &drawn(&scene(&whole)).1.pixels, most).0 * 10 > all, "{name}");
    }
}

/// Where a ray comes into what is kept within a surface it meets it there, at the cut itself.
#[test]
fn caps_lie_in_the_cut() {
    const X: f64 = 0.07;
    for (refine, off) in [(Refine::Exact, 1e-5), (Refine::Linear, 1e-5), (Refine::None, 0.06)] {
        let [volume, _] = above(X);
        let mut settings = settings("gaussian:20", ClipSettings { keep: Keep::Outside, ..volume });
        (settings.surface.iso, settings.surface.refine, settings.camera.eye) = (Some(0.3), refine, [1.5, 0.3, 0.4]);
        let scene = scene(&settings);
        let (plan, frame) = drawn(&scene);
        let [width, _] = plan.view.size;
        let step = scene.settings.sampling.step * scene.field.finest();
        let radius = 0.5 * SIGMA * (-2.0 * 0.3f64.ln()).sqrt();
        let (mut caps, mut all) = (0, 0);
        for (i, met) in frame.surfaces.iter().enumerate() {
            let Some(met) = met else { continue };
            let ray = plan.view.rays.of(i as u32 % width, i as u32 / width);
            let direction = ray.direction;
            let (enter, _) = scene.interval(&ray, plan.view.rays.near).unwrap();
            let place = plan.view.rays.origin + enter * direction + met.steps * step * direction.normalize();
            all += 1;
            // Well within the ball, so that it is no place of its own surface.
            if place.length() < radius - 0.07 {
                assert!((place.x - X).abs() < off && place.x <= X + 1e-6, "{refine:?}: {place}");
                caps += 1;
            }
        }
        assert!(caps > 40 && all > caps, "{caps} caps of {all}");
    }
}

/// The exact integral, which knows the cut by the roots of the clip volume's cubics, and the picture of many samples agree.
#[test]
fn pictures_are_those_of_the_exact_integral() {
    let cases: [(&str, f64, Change); 7] = [
        ("colours", 0.02, |_| {}),
        ("pre-integrated", 0.02, |s| s.sampling.classification = Classification::PreIntegrated),
        ("the greatest value", 0.03, |s| s.projection.kind = MIP.name()),
        ("the mean value", 0.01, |s| s.projection.kind = AVERAGE.name()),
        ("an opaque surface", 0.01, |s| opaque(s, Refine::Exact)),
        ("transparent surfaces", 0.01, |s| {
            s.surface.levels = [0.3, 0.6].map(|iso| SurfaceLevel { iso, color: None, opacity: 0.5 }).into();
            s.surface.refine = Refine::Exact;
        }),
        ("a surface in the volume", 0.03, |s| {
            s.surface.levels = vec![SurfaceLevel { iso: 0.3, color: None, opacity: 0.5 }];
            (s.surface.volume, s.surface.refine) = (true, Refine::Exact);
        }),
    ];
    for keep in [Keep::Inside, Keep::Outside] {
        for (name, most, change) in cases {
            let across =
                ClipSettings { translate: [0.2, 0.1, 0.15], scale: 0.9, rotate: [10.0, 50.0, 0.0], ..ball(0.3, keep) };
            let mut settings = settings("gaussian:20", across);
            settings.transfer.points = Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.3]]);
            settings.sampling.step = 0.1;
            change(&mut settings);
            let scene = scene(&settings);
            let (plan, frame) = drawn(&scene);
            let exact = ExactIntegrator::of(&scene).picture(&plan.view.rays, plan.view.size);
            let (wrong, all) = differing(&exact, &frame.pixels, most);
            println!("{name}, {keep:?}: {wrong} of {all} pixels differ by more than {most}");
            assert!(all > 100 && wrong * 40 <= all, "{name}, {keep:?}: {wrong} of {all}");
        }
    }
}

/// Leaps lose nothing of what a clip volume lays open, in empty space and within surfaces.
#[test]
fn leaps_change_nothing() {
    let cases: [(&str, Change); 4] = [
        ("colours", |_| {}),
        ("values", |s| s.projection.kind = MIP.name()),
        ("an opaque surface", |s| (s.surface.iso, s.surface.shows) = (Some(40.0), Shows::Position)),
        ("a transparent surface", |s| {
            s.surface.levels = vec![SurfaceLevel { iso: 40.0, color: None, opacity: 0.5 }];
        }),
    ];
    for (name, change) in cases {
        // The engine is solid inside, where no value of a surface is near.
        let mut settings =
            settings("engine:40", ClipSettings { translate: [0.1, 0.2, 0.3], ..ball(0.3, Keep::Outside) });
        settings.sampling.samples_per_pass = 4;
        change(&mut settings);
        let scene = scene(&settings);
        for method in METHODS.into_iter().filter(|method| method.loops() && method.looks_ahead()) {
            let [rule, found] = [method.unskipped(), method].map(|method| {
                let mut scene = scene.clone();
                scene.settings.method.name = method.name();
                drawn(&scene).1.pixels
            });
            assert!(rule.iter().any(|pixel| pixel[3] > 0.0), "{name}");
            assert_eq!(rule, found, "{name}, {}", method.name);
        }
        let (wrong, _) =
            differing(&drawn(&scene).1.pixels, &drawn(&Scene { clip_volume: None, ..scene.clone() }).1.pixels, 0.01);
        assert!(wrong > 20, "{name}: the clip volume changes {wrong} pixels");
    }
}

#[test]
fn clip_volume_that_cuts_nothing_is_left_out() {
    let has = |clip: ClipSettings, change: Change| {
        let mut settings = settings("shells:16", clip);
        change(&mut settings);
        let scene = scene(&settings);
        let plan = plan(&scene, None).unwrap();
        let context = Context::new(&scene, &plan.view, &SINGLE_PASS, None, plan.passes);
        let defines =
            plan.steps.iter().filter_map(|step| step.work.shader()).any(|s| s.defines.contains("CLIP_VOLUME"));
        assert_eq!(defines, context.has(&CLIP_VOLUME));
        assert_eq!(plan.left_out.iter().any(|one| one.what == "clip volume"), !defines);
        defines
    };
    assert!(has(clip("gaussian:9", 0.5, Keep::Inside), |_| {}));
    // None of it has reached the level, all of it has and lies about the volume, it lies beside the volume.
    let beside = ClipSettings { translate: [0.0, 1.2, 0.0], ..clip("gaussian:9", 0.5, Keep::Outside) };
    for nothing in [clip("gaussian:9", 2.0, Keep::Outside), clip("gaussian:9", -1.0, Keep::Inside), beside] {
        assert!(!has(nothing.clone(), |_| {}), "{nothing:?}");
        assert!(has(nothing, |s| s.method.planner = false));
    }
    assert!(has(clip("gaussian:9", 2.0, Keep::Inside), |_| {}), "which cuts everything off");
}

#[test]
fn level_beyond_all_values_comes_with_a_warning() {
    let said = |clip: ClipSettings| {
        let scene = scene(&settings("shells:16", clip));
        plan::warnings(&scene, &plan(&scene, None).unwrap())
    };
    let warned = |clip: ClipSettings, says: &str| said(clip).iter().any(|warning| warning.contains(says));
    assert!(!warned(clip("gaussian:9", 0.5, Keep::Inside), "clip.iso"));
    assert!(warned(clip("gaussian:9", 2.0, Keep::Inside), "so that nothing is kept"));
    assert!(warned(clip("gaussian:9", 2.0, Keep::Outside), "so that everything is kept"));
    assert!(warned(clip("constant:9", 0.1, Keep::Outside), "none of it that lies in its box is kept"));
}

#[test]
fn wrong_clip_volumes_are_refused_by_their_key() {
    let good = || clip("gaussian:9", 0.5, Keep::Inside);
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.nrrd");
    std::fs::write(&bad, "NRRD0005\ntype: float\ndimension: 3\nsizes: 900000 900000 900000\nencoding: raw\n\nabc")
        .unwrap();
    let file = |path: &Path| ClipSettings { builtin: None, volume: Some(path.to_owned()), ..good() };
    let cases = [
        (vec![ClipSettings { iso: None, ..file(&bad) }], "clip.iso"),
        (vec![ClipSettings { iso: Some(f64::NAN), ..good() }], "clip.iso"),
        (vec![ClipSettings { builtin: None, ..good() }], "clip.volume"),
        (vec![ClipSettings { volume: Some("a.nrrd".into()), ..good() }], "is given beside builtin"),
        (vec![ClipSettings { path: Some("a.ply".into()), ..good() }], "is given beside a volume"),
        (vec![ClipSettings { keep: Keep::Thesis, ..good() }], "use inside or outside"),
        (vec![ClipSettings { plane: Some([1.0, 0.0, 0.0, 0.0]), ..good() }], "stands beside other keys"),
        (vec![ClipSettings { scale: 0.0, ..good() }], "clip.scale"),
        (vec![ClipSettings { translate: [f64::INFINITY, 0.0, 0.0], ..good() }], "clip.translate"),
        (vec![ClipSettings { transform: Some(vec![[0.0; 4]; 3]), ..good() }], "determinant is 0"),
        (vec![ClipSettings { scale: 1e-30, ..good() }], "no numbers for its place"),
        (vec![ClipSettings { translate: [1e30, 0.0, 0.0], ..good() }], "no numbers for its place"),
        (vec![good(), good()], "keep it to one"),
        (vec![clip("sphere", 0.5, Keep::Inside)], "is not a built-in volume"),
        (vec![file(&folder.path().join("none.nrrd"))], "cannot be read"),
        (vec![file(&bad)], "bad.nrrd"),
    ];
    for (clips, says) in cases {
        let settings = Settings { clips, ..settings("shells:16", good()) };
        let error = read::scene(&settings).unwrap_err().to_string();
        assert!(error.contains(says), "{says} expected: {error}");
    }
}

#[test]
fn what_knows_nothing_of_clip_volumes_refuses_them() {
    let refused = |change: Change| {
        let mut settings = settings("shells:16", clip("gaussian:9", 0.5, Keep::Inside));
        settings.surface.iso = Some(90.0);
        change(&mut settings);
        plan(&scene(&settings), None).unwrap_err().to_string()
    };
    let cases: [(&str, Change); 3] = [
        ("--method rc-ert", |s| s.method.name = RC_ERT.name()),
        ("effects.shadows", |s| s.effects.shadows = true),
        ("effects.translucency", |s| s.effects.translucency = Some(Translucency::default())),
    ];
    for (says, change) in cases {
        let error = refused(change);
        assert!(error.contains(says) && error.contains("clip"), "{error}");
    }
    for method in METHODS.into_iter().filter(|method| !method.loops()) {
        let scene = scene(&settings("shells:16", clip("gaussian:9", 0.5, Keep::Inside)));
        assert!((method.takes)(&scene).is_err(), "{}", method.name);
    }
}

#[test]
fn scene_files_have_clip_volumes() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let header = "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 1 2\nencoding: raw\n\n";
    std::fs::write(folder.path().join("tool.nrrd"), [header.as_bytes(), &[0, 200, 0, 200]].concat()).unwrap();
    std::fs::write(&file, "[[clip]]\nvolume = \"tool.nrrd\"\niso = 100\nkeep = \"outside\"\nscale = 0.5\n").unwrap();
    let found = read::settings(&file).unwrap();
    let expected = ClipSettings {
        volume: Some(folder.path().join("tool.nrrd")),
        iso: Some(100.0),
        keep: Keep::Outside,
        scale: 0.5,
        ..ClipSettings::default()
    };
    assert_eq!(found.clips, [expected]);
    let again: Settings = serde_json::from_str(&serde_json::to_string(&found).unwrap()).unwrap();
    assert_eq!(again, found);
    let mut found = found;
    (found.volume.builtin, found.method.name) = (Some("shells:9x11x14".to_owned()), SINGLE_PASS_OMNI.name());
    let scene = scene(&found);
    let clip = scene.clip_volume.as_deref().unwrap();
    assert_eq!(clip.field.dims(), [2, 1, 2]);
    // Its box reaches to a quarter of the longest side; halfway its value is 100.
    let place = |x: f64| DVec3::new(x, 0.0, 0.0) / scene.field.extent() + 0.5;
    assert_eq!([-0.3, -0.2, 0.01, 0.24, 0.26].map(|x| clip.keeps(place(x))), [true, true, false, false, true]);
    assert!(drawn(&scene).1.pixels.iter().any(|pixel| pixel[3] > 0.0));
}
