//! Views in words.

use crate::scene::Scene;

/// The camera in words, for tables.
pub fn view_in_words(scene: &Scene) -> String {
    let camera = &scene.settings.camera;
    let list = |v: &[f64; 3]| v.map(|c| format!("{}", (c * 1e4).round() / 1e4)).join(",");
    let [width, height] = scene.settings.image.size;
    let lens = match camera.height {
        None => format!("fov {}", camera.fov_y),
        Some(high) => format!("orthographic, {high} high"),
    };
    format!("eye {}, target {}, {lens}, {width}x{height}", list(&camera.eye), list(&camera.target))
}
