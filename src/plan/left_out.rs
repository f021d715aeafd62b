//! What a frame may have and has not, and why.

use crate::feature::FEATURES;
use crate::part::rows::{Context, Feature, Traversal, Why};
use crate::scene::{Region, Scene};

/// Something a frame may have and this one has not.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct LeftOut {
    pub what: String,
    pub why: String,
}

impl LeftOut {
    pub(super) fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into() }
    }
}

/// What the frame may have and has not, with the reasons.
pub(super) fn left_out(context: &Context) -> Vec<LeftOut> {
    let (scene, view, passes) = (context.scene, context.view, context.passes);
    let why = |feature: &&Feature| match context.answer(feature) {
        Err(Why::Because(why)) => Some(LeftOut::new(feature.name, why)),
        Err(Why::Untold) | Ok(()) => None,
    };
    let mut left_out: Vec<LeftOut> = FEATURES.iter().filter_map(why).collect();
    let [width, height] = view.size;
    if view.region.size() != view.size {
        let Region { width: w, height: h, .. } = view.region;
        left_out.push(LeftOut::new("pixels of targets", format!("the box covers {w} x {h} of {width} x {height}")));
    }
    let drawn = context.drawn_passes().count();
    if view.tiles.is_some() && !context.method.loops() && drawn < passes as usize {
        let others = passes as usize - drawn;
        left_out.push(LeftOut::new(
            format!("{others} of the main passes"),
            "nothing can show in any tile of them".to_owned(),
        ));
    }
    if context.method.loops() {
        if scene.settings.sampling.passes > 0 {
            left_out.push(LeftOut::new("forced main passes", "one pass holds the whole ray"));
        }
    } else if context.method.traversal == Traversal::Shells {
        if scene.settings.sampling.passes > 0 {
            left_out.push(LeftOut::new("forced main passes", "each shell is a pass"));
        }
        if scene.surface.is_some() {
            left_out.push(LeftOut::new("places between samples", "polygons tell where the surface is"));
        }
    } else if context.method.stack().is_some() {
        if scene.settings.sampling.passes > 0 && context.method.back_to_front() {
            left_out.push(LeftOut::new("forced main passes", "one pass draws all slices"));
        }
    } else if context.method.traversal == Traversal::Passes
        && scene.settings.method.planner
        && scene.settings.sampling.passes == 0
    {
        let diagonal = whole_diagonal(scene).div_ceil(scene.settings.sampling.samples_per_pass);
        if diagonal > passes {
            let last = diagonal - 1;
            left_out.push(LeftOut::new(
                if passes == last { format!("main pass {last}") } else { format!("main passes {passes} to {last}") },
                format!("the longest ray of this view has {} samples", view.longest_samples),
            ));
        }
    }
    left_out
}

/// Samples on the diagonal of the volume, the longest ray of any view.
pub(super) fn whole_diagonal(scene: &Scene) -> u32 {
    let step = scene.settings.step() * scene.field.finest();
    (scene.field.extent().length() / step).ceil() as u32
}
