//! What a reader of the numbers should know, in sentences.

use crate::frame::{FrameRun, LayerCounts};
use crate::plan::Plan;
use crate::scene::{Effect, Scene};

/// What a reader of the numbers should know of an effect; `robust`: whether what shaders read is held within what is there.
pub(super) fn with_effect(effect: &Effect, robust: bool) -> String {
    let access = if robust { "; the device checks what shaders read (robust access), which may take time" } else { "" };
    format!(
        "samples that show, or surfaces, go through the effect {}: its GLSL does not run in f64, so that there is no error against \
         the reference{access}",
        effect.words()
    )
}

/// What each part of rays between layers has: of polygons, or of faces by which rays enter a mesh of cells.
pub(super) fn parts_between_layers(run: &FrameRun) -> Option<String> {
    let layers = &run.fragments.as_ref()?.layers;
    let told = |(i, layer): (usize, &LayerCounts)| {
        let place = if i == 0 { "in front".to_owned() } else { format!("behind layer {}", i - 1) };
        let LayerCounts { pixels, main, intermediate } = layer;
        let up_to = pixels.map_or_else(String::new, |pixels| format!(", up to {pixels} pixels of polygons"));
        format!("{place} {main} main and {intermediate} intermediate{up_to}")
    };
    // Behind the last layer that a ray has there is nothing.
    let anything = |layer: &LayerCounts| layer.main + layer.intermediate + layer.pixels.unwrap_or(0) > 0;
    let last = layers.iter().rposition(anything);
    // Rays through cells have no part in front of the first layer.
    let is_there = |(i, layer): &(usize, &LayerCounts)| *i > 0 || layer.pixels.is_some() || anything(layer);
    let shown = layers[..last.map_or(0, |last| last + 1)].iter().enumerate().filter(is_there);
    let parts: Vec<String> = shown.map(told).collect();
    (!parts.is_empty()).then(|| format!("fragments of the parts of rays between layers: {}", parts.join("; ")))
}

/// The triangles in a note on how many polygons a frame of shells draws; none in another note.
pub fn triangles_in(note: &str) -> Option<u64> {
    let (shells, triangles) = note.strip_suffix(" triangles")?.split_once(" of ")?;
    let is_of_shells = shells.ends_with(" shells") || shells.ends_with(" shell");
    triangles.parse().ok().filter(|_| is_of_shells)
}

/// How many polygons a frame of shells draws.
pub(super) fn polygons_of_shells(scene: &Scene, plan: &Plan) -> Option<String> {
    let shells = scene.shells.as_ref().filter(|_| !plan.method.takes_samples())?;
    let triangles = shells.triangles(&scene.field);
    let count = match shells.drawn().len() {
        1 => "1 shell".to_owned(),
        count => format!("{count} shells"),
    };
    Some(format!("{count} of {triangles} triangles"))
}
