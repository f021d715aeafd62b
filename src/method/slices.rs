//! `slices-*`: slices of the volume, back to front [Thesis §3.4]; `+ftb`: front to back, so that rays end early and what shows nothing is
//! skipped [Thesis ch. 5 §5.7]. Passes of slices are what main passes are to ray casters, and are decided about by the same passes.

use super::near_neighbor;
use super::rc_block;
use super::rows::{BOUNDS, RAY_CASTER, begin, cast, culled_forms, main, peel, switched, takes_in_passes};
use crate::error::{Error, Result};
use crate::feature::layers::first_section;
use crate::part::rows::{Ahead, Context, Method, Traversal};
use crate::part::steps::Steps;
use crate::pass::layer;
use crate::pass::termination::termination;
use crate::scene::Scene;
use crate::scene::settings::{Distance, Gradients, Last, SliceCut};
use crate::scene::slices::Stack;

/// Slices back to front.
const fn back_to_front(stack: Stack, name: &'static str, about: &'static str, source: &'static str) -> Method {
    Method {
        name,
        about,
        source,
        takes,
        papers: None,
        forms: Vec::new,
        ends_rays: false,
        traversal: Traversal::Slices(stack),
        steps: draw_all,
        ..RAY_CASTER
    }
}

/// The same slices front to back, until rays are opaque.
const fn front_to_back(of: Method, name: &'static str, about: &'static str) -> Method {
    Method {
        name,
        about,
        source: "Thesis ch. 5 §5.7",
        papers: RAY_CASTER.papers,
        forms: RAY_CASTER.forms,
        ends_rays: true,
        steps: |context, steps| cast(context, steps, |context, steps| switched(context, steps, 1, termination)),
        ..of
    }
}

/// The same, and blocks that are empty are skipped.
const fn by_blocks(of: &'static Method, name: &'static str, about: &'static str) -> Method {
    Method {
        name,
        about,
        ahead: Ahead::Blocks,
        skips_of: Some(of),
        steps: |context, steps| cast(context, steps, rc_block::passes),
        ..*of
    }
}

/// The same by near-neighbor skipping.
const fn by_distances(of: &'static Method, distance: Distance, name: &'static str, about: &'static str) -> Method {
    Method {
        name,
        about,
        papers: BOUNDS,
        forms: culled_forms,
        ahead: Ahead::Distances(distance),
        skips_of: Some(of),
        steps: |context, steps| cast(context, steps, near_neighbor::passes),
        ..*of
    }
}

pub const SLICES_3D: Method =
    back_to_front(Stack::View, "slices-3d", "Slices across the view direction, back to front", "Thesis §3.4.2");

pub const SLICES_3D_FTB: Method =
    front_to_back(SLICES_3D, "slices-3d+ftb", "slices-3d front to back, with early ray termination");

pub const SLICES_3D_BLOCK: Method =
    by_blocks(&SLICES_3D_FTB, "slices-3d-block+ftb", "slices-3d+ftb with skipping of empty 8^3 blocks");

pub const SLICES_3D_OMNI: Method = by_distances(
    &SLICES_3D_FTB,
    Distance::Omni,
    "slices-3d-omni+ftb",
    "slices-3d+ftb with near-neighbor skipping, distance in any direction",
);

pub const SLICES_2D: Method = Method {
    takes: takes_in_2d,
    ..back_to_front(
        Stack::Objects,
        "slices-2d",
        "Slices across an axis of the volume, of a stack of 2D textures, back to front",
        "Thesis §3.4.1",
    )
};

pub const SLICES_2D_FTB: Method =
    front_to_back(SLICES_2D, "slices-2d+ftb", "slices-2d front to back, with early ray termination");

pub const SLICES_2D_BLOCK: Method =
    by_blocks(&SLICES_2D_FTB, "slices-2d-block+ftb", "slices-2d+ftb with skipping of empty 8^3 blocks");

pub const SLICES_2D_OMNI: Method = by_distances(
    &SLICES_2D_FTB,
    Distance::Omni,
    "slices-2d-omni+ftb",
    "slices-2d+ftb with near-neighbor skipping, distance in any direction",
);

pub const SLICES_SHELLS: Method = Method {
    takes: takes_spheres,
    ..back_to_front(
        Stack::Shells,
        "slices-shells",
        "Slices on spheres about the eye, which are as far from each other along every ray, back to front",
        "Thesis §3.4.2",
    )
};

pub const SLICES_SHELLS_FTB: Method =
    front_to_back(SLICES_SHELLS, "slices-shells+ftb", "slices-shells front to back, with early ray termination");

pub const SLICES_SHELLS_BLOCK: Method =
    by_blocks(&SLICES_SHELLS_FTB, "slices-shells-block+ftb", "slices-shells+ftb with skipping of empty 8^3 blocks");

pub const SLICES_SHELLS_OMNI: Method = by_distances(
    &SLICES_SHELLS_FTB,
    Distance::Omni,
    "slices-shells-omni+ftb",
    "slices-shells+ftb with near-neighbor skipping, distance in any direction",
);

/// Takes every scene that passes take, whose samples are on slices alone.
fn takes(scene: &Scene) -> Result<()> {
    takes_in_passes(scene)?;
    let method = format!("--method {}", scene.settings.method.name);
    if scene.surface.is_some() {
        return Err(Error::usage(
            method,
            "finds no iso-surfaces, which are between its samples",
            "use a ray caster, or leave the surface out (--iso)",
        ));
    }
    match scene.last() {
        Last::Full => Ok(()),
        Last::Partial | Last::None => Err(Error::usage(
            method,
            "has no last segment of a ray: every slice stands for the way to the next one",
            "use --last full, or a ray caster",
        )),
    }
}

/// Takes every scene that slices take and whose slices the host cuts: the vertex shader cuts no spheres.
fn takes_spheres(scene: &Scene) -> Result<()> {
    takes(scene)?;
    match scene.settings.method.slice_cut {
        SliceCut::Host => Ok(()),
        SliceCut::Device => Err(Error::usage(
            "--slice-cut device",
            format!("{} has spheres, which the vertex shader does not cut", scene.settings.method.name),
            "use --slice-cut host, or --method slices-3d",
        )),
    }
}

/// Takes every scene that slices take and whose samples do not have their values beside gradients.
fn takes_in_2d(scene: &Scene) -> Result<()> {
    takes(scene)?;
    match scene.reads_gradients() && scene.settings.shading.gradients == Gradients::Precomputed {
        false => Ok(()),
        true => Err(Error::usage(
            format!("--method {}", scene.settings.method.name),
            "takes values from 2D textures, and precomputed gradients have them in a 3D texture",
            "use --gradients on-the-fly, or --method slices-3d",
        )),
    }
}

/// All slices back to front, behind layers of polygons first [Thesis ch. 6 §2.1].
fn draw_all(context: &Context, steps: &mut Steps) {
    if context.passes > 0 {
        begin(context, steps);
    }
    let guards = peel(context, steps);
    steps.enter(0, None);
    steps.extend(context.opaque.then(|| layer::opaque(context)));
    let parts: Vec<Context> = context.sections(first_section(context)).collect();
    for part in parts.into_iter().rev() {
        // Without the layer in front there is nothing behind it.
        let guard = part.section.checked_sub(1).map(|layer| guards[layer as usize]);
        steps.enter(0, guard);
        steps.extend((context.blends && part.section < context.layers).then(|| layer::layer(&part, part.section)));
        steps.enter(part.section, guard);
        steps.extend((context.passes > 0).then(|| main(&part, 0, None)));
    }
}
