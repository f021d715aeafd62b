//! Twin of `glsl/shells.frag`, and of what the depth test makes of shells and of surfaces among them [Heidrich95 §2].

use super::lighting::RoundedPlace;
use super::{Effect, Pixel, Twin};
use crate::scene::settings::{ShellMode, ShellSum};
use crate::scene::shells::{Shell, ShellCrossing, ShellDepth, crossing_of};

/// What f32 takes from a place on a ray, relative to the way there.
const PLACE_ROUNDING: f64 = 1e-6;

/// What f32 takes from a brightness, relative to the greatest there is.
const BRIGHTNESS_ROUNDING: f64 = 4e-7;

/// Draws a shell, by its number from the dimmest on.
pub fn shell(twin: &Twin, pixel: &mut Pixel, number: u32) -> Effect {
    let Some((shells, depth)) = twin.scene.shells.as_ref().zip(twin.shell_depth()) else { return Effect::Silent };
    let shell = &shells.list[number as usize];
    let at = [pixel.column, pixel.row];
    let crossings = shell.crossings(&twin.scene.field, &twin.rays, at, &depth, twin.raster);
    let settings = &twin.scene.settings.shells;
    let mut effect = (0, 0);
    for crossing in &crossings.list {
        let (fragments, contributed) = match (settings.mode, settings.sum) {
            (Some(ShellMode::Max), _) => twin.brighter(pixel, shell, crossing, &depth),
            (Some(ShellMode::Surface), _) => twin.outermost(pixel, crossing, &depth),
            (_, ShellSum::Crossings) => {
                let of = |pixel: &mut Pixel| {
                    let rise = depth.cue(1.0) - depth.cue(0.0);
                    pixel.rounding += shell.emission * rise * crossing.spread;
                    shell.emission * depth.cue(crossing.stored)
                };
                twin.added(pixel, crossing, of)
            }
            (_, ShellSum::Lengths) => twin.added(pixel, crossing, |pixel| twin.way(pixel, shell, crossing, &depth)),
        };
        effect = (effect.0 + fragments, effect.1 + contributed);
    }
    Effect::Several { fragments: effect.0, contributed: effect.1 }
}

/// Lights the shell that the ray has met, where its polygons are.
pub fn lighting(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let [steps, _, _, met] = pixel.hit;
    if met == 0.0 {
        return Effect::Discarded;
    }
    twin.put_surface(pixel, RoundedPlace { steps, rounding: pixel.cut }, 0);
    Effect::Silent
}

/// Draws opaque polygons into the depth buffer, where the greatest is to be found as a shell has its depth.
pub fn surfaces(twin: &Twin, pixel: &mut Pixel, number: u32) -> Effect {
    let Some((shells, depth)) = twin.scene.shells.as_ref().zip(twin.shell_depth()) else { return Effect::Silent };
    let mode = twin.scene.settings.shells.mode.unwrap_or(ShellMode::Sum);
    let range = depth.range(mode, shells.list.get(number as usize).map_or(0.0, |shell| shell.emission));
    let polygons = &twin.scene.polygons;
    let at = [pixel.column, pixel.row];
    let mut met = polygons.crossings(&twin.rays, at, twin.raster).list;
    met.retain(|crossing| polygons.opaque().contains(&(crossing.triangle as usize)));
    met.sort_by_key(|crossing| crossing.triangle);
    let mut fragments = 0;
    for crossing in met {
        let corners = polygons.triangles[crossing.triangle as usize].corners;
        let Some(crossing) = crossing_of(&twin.rays, at, crossing.triangle, corners, &depth, twin.raster) else {
            continue;
        };
        if crossing.stored < 0.0 {
            continue;
        }
        fragments += u64::from(twin.nearer(pixel, &crossing, range));
    }
    Effect::Several { fragments, contributed: 0 }
}

impl Twin<'_> {
    fn shell_depth(&self) -> Option<ShellDepth> {
        ShellDepth::of(self.scene, &self.rays)
    }

    /// Whether a fragment passes the depth test with depths that 0 and 1 are taken to, and is kept in the depth buffer.
    fn nearer(&self, pixel: &mut Pixel, crossing: &ShellCrossing, range: [f32; 2]) -> bool {
        let [far, near] = range.map(f64::from);
        let depth = f64::from((far + crossing.stored * (near - far)) as f32);
        let spread = (near - far).abs() * crossing.spread;
        // Of shells without a depth cue all depths are equal, to the bit.
        pixel.undecided |= spread > 0.0 && (depth - pixel.shell_depth).abs() <= spread + pixel.shell_spread;
        let passes = depth > pixel.shell_depth;
        if passes {
            (pixel.shell_depth, pixel.shell_spread) = (depth, spread);
        }
        passes
    }

    /// A fragment where the greatest is to be found.
    fn brighter(&self, pixel: &mut Pixel, shell: &Shell, crossing: &ShellCrossing, depth: &ShellDepth) -> (u64, u64) {
        let range = depth.range(ShellMode::Max, shell.emission);
        let reach = f64::from((range[1] - range[0]).abs()) * crossing.spread + BRIGHTNESS_ROUNDING;
        let before = pixel.shell_depth;
        if !self.nearer(pixel, crossing, range) {
            // The rasteriser may see it in front all the same, and then a little in front.
            return (0, 0);
        }
        let brightness = self.projection.grey(pixel.shell_depth / depth.scale);
        pixel.accumulated = self.blend().apply(pixel.accumulated, brightness);
        pixel.rounding = reach / depth.scale;
        (1, u64::from(before == 0.0))
    }

    /// A fragment of the outermost shell.
    fn outermost(&self, pixel: &mut Pixel, crossing: &ShellCrossing, depth: &ShellDepth) -> (u64, u64) {
        if !self.nearer(pixel, crossing, depth.range(ShellMode::Surface, 0.0)) {
            return (0, 0);
        }
        let ray = self.rays.of(pixel.column, pixel.row);
        let begin = (pixel.entry - 0.5) * self.scene.field.extent();
        let place = ray.origin + crossing.depth * ray.direction;
        let steps = (place - begin).dot(pixel.direction) / self.step_length();
        let first = pixel.hit[3] == 0.0;
        pixel.hit = [steps.max(0.0), steps.max(0.0), 0.0, 1.0];
        pixel.cut = crossing.moved(depth) * ray.direction.length() / self.step_length() + PLACE_ROUNDING * steps.abs();
        (1, u64::from(first))
    }

    /// A fragment of a sum.
    fn added(&self, pixel: &mut Pixel, crossing: &ShellCrossing, value: impl Fn(&mut Pixel) -> f64) -> (u64, u64) {
        let behind = pixel.shell_spread > 0.0;
        pixel.undecided |=
            behind && (crossing.stored - pixel.shell_depth).abs() <= crossing.spread + pixel.shell_spread;
        if behind && crossing.stored <= pixel.shell_depth {
            return (0, 0);
        }
        let value = value(pixel);
        pixel.rounding += BRIGHTNESS_ROUNDING * value.abs();
        pixel.accumulated = self.blend().apply(pixel.accumulated, self.projection.grey(value));
        (1, 1)
    }

    /// The way within a shell from a crossing on, or to it, times the rise of the emission there; a part of a sum in which the way from
    /// where rays meet a surface, or from the middle, has no part.
    fn way(&self, pixel: &mut Pixel, shell: &Shell, crossing: &ShellCrossing, depth: &ShellDepth) -> f64 {
        let ray = self.rays.of(pixel.column, pixel.row);
        let lengths = ray.direction.length() / (self.scene.transfer.reference * self.scene.field.finest());
        let enter = self.scene.interval(&ray, self.rays.near).map_or(0.0, |(enter, _)| enter);
        let end = pixel.opaque.map_or(depth.middle(&self.rays), |surface| {
            enter + surface.steps * self.step_length() / ray.direction.length()
        });
        let sign = if crossing.enters { 1.0 } else { -1.0 };
        pixel.rounding += shell.rise * lengths * depth.cue(crossing.stored) * crossing.moved(depth);
        sign * shell.rise * lengths * depth.between(crossing.depth, end)
    }
}
