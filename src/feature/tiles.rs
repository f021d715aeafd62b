//! Tiles of pixels behind which nothing shows, and whose rays need not be begun.

use crate::error::{Error, Result};
use crate::part::rows::{Method, Traversal};
use crate::projection;
use crate::scene::Scene;
use crate::scene::along_rays::AlongRays;
use crate::scene::settings::Tiles;
use crate::scene::tiles::InPasses;
use crate::scene::view::View;
use crate::structure::content;

/// Whether a method leaves out whole tiles where it is asked to: ray casters that know what lies ahead, but for compute shaders; others
/// draw all.
pub fn are_left_out_by(method: &Method) -> bool {
    matches!(method.traversal, Traversal::FragmentLoop | Traversal::Passes) && method.looks_ahead()
}

/// Pixels that a pass covers in the time of a draw: on lavapipe, where a draw takes 14 to 27 microseconds and a pixel 0.003, 4,700 and more
/// (`benches/results/lavapipe-22.3/limit.md`).
const OF_A_DRAW: u64 = 4096;

/// A view in live tiles alone; in each of so many main passes, where the method has such, in those in which its samples may show something.
pub fn draw_live(scene: &Scene, method: &Method, view: View, passes: u32) -> View {
    let in_passes = (!method.loops()).then(|| InPasses {
        along: AlongRays::new(scene, &view.rays),
        step: scene.settings.step() * scene.field.finest(),
        samples: scene.settings.sampling.samples_per_pass,
        passes,
        draw: OF_A_DRAW,
    });
    view.in_tiles(content::boxes(scene, in_passes.is_some()).into_iter(), in_passes.as_ref())
}

/// Whether a method draws only tiles behind which something may show.
pub fn only_live(scene: &Scene, method: &Method) -> bool {
    scene.settings.method.tiles == Tiles::Live && are_left_out_by(method)
}

/// Whether all rays of other tiles leave the picture as it is.
///
/// # Errors
/// When a ray that comes to nothing has something to show.
pub fn serve(scene: &Scene) -> Result<()> {
    let refused = |problem: &str, remedy: &str| Err(Error::usage("method.tiles (--tiles live)", problem, remedy));
    let row = projection::of(&scene.settings);
    match () {
        () if row.shows_values() => refused(
            &format!("are those of what shows, and rays have values elsewhere under --projection {}", row.name),
            "use composite, or leave it out",
        ),
        () if scene.backdrop.is_some() || scene.settings.effects.refraction.is_some() => refused(
            "are those of straight rays that show nothing behind the volume",
            "leave it out, or effects.refraction and effects.background",
        ),
        () if scene.polygons.show() || !scene.polygons.clips().is_empty() => {
            refused("are those of the volume, and meshes show besides", "leave it out, or the meshes")
        }
        () => Ok(()),
    }
}

/// Whether tiles that are asked for can be left out.
///
/// # Errors
/// As [`serve`].
pub fn check(scene: &Scene, method: &Method) -> Result<()> {
    if only_live(scene, method) { serve(scene) } else { Ok(()) }
}
