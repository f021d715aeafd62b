//! Slices that the vertex shader cuts show what those of the host do, bit for bit and fragment for fragment.

use std::sync::Arc;

use depthleap::method::METHODS;
use depthleap::scene::Scene;
use depthleap::scene::settings::{ClipSettings, SliceCut};
use depthleap::scene::slices::Stack;
use depthleap::vulkan::Device;

use super::scenes::{Stage, VIEWS, by, differing, exactly, forms_here, scene, seen};
use crate::harness::{Test, share, test};

/// A scene by its name.
type Named = (&'static str, fn() -> Scene);

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    let scenes: [Named; 4] = [
        ("in_perspective", || scene("shells:24x20x16", "ramp", exactly)),
        ("side_by_side", || {
            scene("jets:20", "ramp", |s| {
                exactly(s);
                s.camera.height = Some(1.3);
            })
        }),
        ("behind_a_clip_plane", || {
            scene("blocks:24", "linear", |s| {
                exactly(s);
                s.clips = vec![ClipSettings { plane: Some([0.6, -0.3, 0.7, 0.1]), ..ClipSettings::default() }];
            })
        }),
        ("between_no_textures", || {
            scene("jets:18x24x20", "surface", |s| {
                exactly(s);
                s.method.between = false;
            })
        }),
    ];
    for (number, (name, scene)) in scenes.into_iter().enumerate() {
        tests.push(test(&format!("slices::cut_by_the_vertex_shader::{name}"), move |device| {
            alike(device, &scene(), number);
        }));
    }
    tests.push(test("slices::cut_by_the_vertex_shader::from_within", |device| {
        let inside = scene("shells:24", "haze", |s| {
            exactly(s);
            s.camera.eye = [0.11, -0.07, 0.2];
            s.camera.target = [0.4, 0.3, -0.2];
        });
        held(device, &inside, 0);
    }));
    tests
}

/// From some sides.
fn alike(device: &Arc<Device>, scene: &Scene, number: usize) {
    for view in share(VIEWS.into_iter().take(3), number) {
        held(device, &seen(scene, view), number);
    }
}

/// Every method with planes, cut here and there.
fn held(device: &Arc<Device>, scene: &Scene, number: usize) {
    let mut stage = Stage::new(device);
    let planes = METHODS.into_iter().filter(|method| method.stack().is_some_and(|stack| stack != Stack::Shells));
    for method in share(planes, number) {
        let host = by(scene, method.name());
        let mut cut = host.clone();
        cut.settings.method.slice_cut = SliceCut::Device;
        let form = forms_here(device, &host).pop().flatten();
        let (host, cut) = (stage.shoot(&host, form), stage.shoot(&cut, form));
        assert!(host.picture.iter().any(|pixel| pixel[3] > 0.0), "{}: nothing shows", method.name);
        let differs = differing(&host.picture, &cut.picture);
        assert_eq!(differs, 0, "{}: {differs} pixels differ", method.name);
        assert_eq!(host.run.fragments, cut.run.fragments, "{}", method.name);
    }
}
