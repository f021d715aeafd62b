//! Emissions of shells, by methods of all kinds [Heidrich95 §2].

use crate::error::{Error, Result};
use crate::part::rows::Method;
use crate::projection;
use crate::scene::Scene;
use crate::scene::settings::{ProjectionName, ShellMode, ShellSum};

/// Whether a method shows what settings ask of shells.
///
/// # Errors
/// When they ask for another projection as well, or for what shells alone can show.
pub fn check(scene: &Scene, method: &Method) -> Result<()> {
    let settings = &scene.settings.shells;
    let Some(mode) = settings.mode else { return Ok(()) };
    let cue = settings.a != 0.0 || settings.beta0 + settings.b != 1.0;
    if mode == ShellMode::Surface {
        return match cue {
            true => Err(Error::usage(
                "shells.beta0, a, b (--shell-beta0, --shell-a, --shell-b)",
                "ask for a depth cue of emissions, and --shells surface shows a surface in light",
                "leave them out",
            )),
            false => Ok(()),
        };
    }
    let (asked, of_mode) = (scene.settings.projection.kind, projection::of(&scene.settings).name());
    if asked != ProjectionName::default() && asked != of_mode {
        return Err(Error::usage(
            format!("projection.kind (--projection {asked})"),
            format!("is another one than that of shells, {of_mode}"),
            "leave one of --projection and --shells out",
        ));
    }
    if !method.takes_samples() {
        return Ok(());
    }
    let alone = |input: &str, problem: &str| {
        let problem = format!("{problem}, which --method {} does not show", method.name);
        Err(Error::usage(input, problem, "use --method shells, or leave it out"))
    };
    match () {
        () if cue => alone("shells.beta0, a, b (--shell-beta0, --shell-a, --shell-b)", "ask for a depth cue"),
        () if mode == ShellMode::Sum && settings.sum == ShellSum::Crossings => {
            alone("shells.sum (--shell-sum) crossings", "asks for a sum over polygons")
        }
        () if !settings.disabled.is_empty() => alone("shells.disabled (--shell-disabled)", "leaves shells out"),
        () => Ok(()),
    }
}
