//! Clip geometry: pictures and counts are those of the twins, in every form, and skipping changes nothing.

use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{ClipSettings, Last, MeshSettings, Offset};

use super::layers::{held, mesh, most_layers, view_for};
use super::scenes::{exactly, scene};
use crate::harness::{Need, Test, test};

/// Clip geometry, and the meshes beside it.
type Geometry = fn() -> (Vec<ClipSettings>, Vec<MeshSettings>);

const SCENES: [(&str, Geometry); 12] = [
    ("inside of a sphere", || (vec![clip("sphere:8", Keep::Inside)], Vec::new())),
    ("outside of a sphere", || (vec![clip("sphere:8", Keep::Outside)], Vec::new())),
    ("inside of a torus", || (vec![clip("torus:7", Keep::Inside)], Vec::new())),
    ("outside of faces that cut each other", || (vec![clip("teapot:5", Keep::Outside)], Vec::new())),
    ("outside of what the eye is in", || {
        (vec![ClipSettings { scale: 1.5, translate: [0.0, 0.0, 1.0], ..clip("box", Keep::Outside) }], Vec::new())
    }),
    ("inside of what the eye is in", || {
        (vec![ClipSettings { scale: 3.0, translate: [0.1, 0.0, 1.2], ..clip("sphere:6", Keep::Inside) }], Vec::new())
    }),
    ("through the eye", || {
        (vec![ClipSettings { scale: 1.0, translate: [0.0, 0.1, 1.91], ..clip("sphere:6", Keep::Outside) }], Vec::new())
    }),
    ("what both keep", || {
        let hole = ClipSettings { scale: 0.4, translate: [0.2, 0.1, 0.2], ..clip("box", Keep::Outside) };
        (vec![ClipSettings { scale: 0.9, ..clip("sphere:8", Keep::Inside) }, hole], Vec::new())
    }),
    ("with polygons on both sides", || {
        let opaque = MeshSettings { opacity: 1.0, scale: 0.3, translate: [-0.2, 0.1, 0.0], ..mesh("box") };
        (vec![clip("sphere:8", Keep::Outside)], vec![mesh("torus:7"), opaque])
    }),
    ("behind the first surface", || {
        (vec![ClipSettings { scale: 2.0, translate: [0.3, 0.2, -0.5], ..clip("sphere:8", Keep::Thesis) }], Vec::new())
    }),
    ("behind what does not cover the volume", || (vec![clip("torus:7", Keep::Thesis)], Vec::new())),
    ("behind the first surface, which hides polygons", || {
        let opaque = MeshSettings { opacity: 1.0, scale: 0.3, translate: [0.2, 0.0, 0.1], ..mesh("box") };
        (vec![clip("sphere:8", Keep::Thesis)], vec![MeshSettings { scale: 1.1, ..mesh("box") }, opaque])
    }),
];

fn clip(builtin: &str, keep: Keep) -> ClipSettings {
    ClipSettings {
        builtin: Some(builtin.to_owned()),
        rotate: [17.0, 29.0, 41.0],
        scale: 0.8,
        keep,
        ..ClipSettings::default()
    }
}

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (number, (name, geometry)) in SCENES.into_iter().enumerate() {
        for (turn, last) in [Last::Full, Last::Partial].into_iter().enumerate() {
            let scene = move || {
                scene("shells:24", "ramp", |settings| {
                    exactly(settings);
                    (settings.clips, settings.meshes) = geometry();
                    settings.image.size = [62, 50];
                    settings.sampling.last = last;
                    if last == Last::Partial {
                        (settings.sampling.offset, settings.sampling.step) = (Offset::Midpoint, 0.8);
                    }
                })
            };
            let kind = if last == Last::Full { "whole samples" } else { "parts of samples" };
            let one = test(&format!("clips::{name}::{kind}"), move |device| {
                let mut scene = scene();
                // As many as there are, and one that ends the peeling.
                scene.settings.layers.most = most_layers(&scene) + 1;
                held(device, &scene, view_for(last), turn);
            });
            tests.push(one.needs(Need::Turn(number + turn)));
        }
    }
    tests
}
