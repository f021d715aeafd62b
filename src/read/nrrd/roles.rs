//! Which axes of an NRRD file are space, which number the values of a voxel, and which the volumes of a sequence; and
//! which of these the user wants.

use std::path::Path;

use super::axes::{Axis, Direction};
use crate::error::{Error, Result};
use crate::read::ReadChoice;
use crate::scene::settings::Component;

/// The axes of a file by what they mean. Others have one entry.
#[derive(Debug, PartialEq)]
pub struct Roles {
    /// Two (a picture) or three.
    pub space: Vec<usize>,
    pub component: Option<usize>,
    pub frame: Option<usize>,
}

#[derive(Clone, Copy, PartialEq)]
enum AxisRole {
    Space,
    Component,
    Frame,
    /// The header does not say.
    Unsaid,
}

fn role(axis: &Axis, last: bool) -> AxisRole {
    let beyond_space = if last { AxisRole::Frame } else { AxisRole::Component };
    match (axis.kind.as_deref(), axis.direction) {
        (Some("time"), _) => AxisRole::Frame,
        (Some("list"), _) | (None | Some("domain" | "space"), Direction::None) => beyond_space,
        (Some("domain" | "space"), _) | (None, Direction::Known(..)) => AxisRole::Space,
        (None, _) => AxisRole::Unsaid,
        (Some(_), _) => AxisRole::Component,
    }
}

/// What the axes mean.
///
/// # Errors
/// When the header does not say enough, or says that the file is no volume.
pub fn of(path: &Path, axes: &[Axis], choice: &ReadChoice) -> Result<Roles> {
    let last = |a: usize| a + 1 == axes.len();
    let mut roles: Vec<AxisRole> = axes.iter().enumerate().map(|(a, axis)| role(axis, last(a))).collect();
    let said = roles.iter().filter(|role| **role == AxisRole::Space).count();
    for (a, role) in roles.iter_mut().enumerate().filter(|(_, role)| **role == AxisRole::Unsaid) {
        *role = match said {
            0..3 => AxisRole::Space,
            _ if last(a) => AxisRole::Frame,
            _ => AxisRole::Component,
        };
    }
    let with = |wanted: AxisRole| (0..axes.len()).filter(|a| roles[*a] == wanted).collect::<Vec<_>>();
    let many = |wanted: AxisRole| with(wanted).into_iter().filter(|a| axes[*a].size > 1).collect::<Vec<_>>();
    let (mut space, mut components, mut frames) =
        (with(AxisRole::Space), many(AxisRole::Component), many(AxisRole::Frame));
    while space.len() > AXES {
        let (first, end) = (space[0], space.len() - 1);
        if axes[first].size == 1 {
            space.remove(0);
        } else if axes[space[end]].size == 1 {
            space.pop();
        } else if choice.frame.is_some() && frames.is_empty() {
            frames.extend(space.pop());
        } else if choice.component.is_some() && components.is_empty() {
            components.push(space.remove(0));
        } else {
            return Err(ambiguous(path, axes, &space));
        }
    }
    let one = |axes: &[usize], what: &str| match axes {
        [] => Ok(None),
        [one] => Ok(Some(*one)),
        several => {
            let problem = format!("says that axes {several:?} all number {what}");
            Err(Error::input(format!("{}: kinds", path.display()), problem, "give a file with one such axis"))
        }
    };
    if space.len() < PICTURE_AXES {
        let problem = format!("has {} axes, of which {} may lie in space", axes.len(), space.len());
        let remedy = "give a file with three such axes (a volume) or two (a picture)";
        return Err(Error::input(format!("{}: dimension", path.display()), problem, remedy));
    }
    Ok(Roles { space, component: one(&components, "the values of a voxel")?, frame: one(&frames, "volumes")? })
}

/// Axes of a volume.
const AXES: usize = 3;
/// Axes of a picture.
const PICTURE_AXES: usize = 2;

fn ambiguous(path: &Path, axes: &[Axis], space: &[usize]) -> Error {
    let (first, last) = (space[0], space[space.len() - 1]);
    let problem = format!("has {} axes and does not say which {AXES} of them are space", axes.len());
    let remedy = format!(
        "write `kinds`, or take axis {first} for the values of a voxel with --component 0 to {}, or axis {last} for a \
         sequence of {} volumes with --frame 0 to {}",
        axes[first].size - 1,
        axes[last].size,
        axes[last].size - 1
    );
    Error::input(format!("{}: sizes", path.display()), problem, remedy)
}

impl Roles {
    /// Whether the user chose what the file has.
    ///
    /// # Errors
    /// When a choice is missing, does not apply to the file, or lies outside what it holds.
    pub fn check(&self, path: &Path, axes: &[Axis], choice: &ReadChoice) -> Result<()> {
        let size = |axis: Option<usize>| axis.map_or(1, |a| axes[a].size);
        let kind = self.component.and_then(|a| axes[a].kind.as_deref());
        self.check_component(path, size(self.component), kind, choice)?;
        let bad = |problem: String, remedy: String| {
            Err(Error::input(format!("{}: volume.frame (--frame)", path.display()), problem, remedy))
        };
        let count = size(self.frame);
        match choice.frame {
            None if count > 1 && self.space.len() == AXES => {
                bad(format!("is needed: the file holds {count} volumes"), format!("choose one from 0 to {}", count - 1))
            }
            Some(n) if self.frame.is_none() && n > 0 => {
                bad(format!("is {n}, and the file holds one volume"), "leave it out".into())
            }
            Some(n) if self.frame.is_some() && n >= count => {
                bad(format!("is {n}, and the file holds {count}"), format!("choose one from 0 to {}", count - 1))
            }
            _ => Ok(()),
        }
    }

    fn check_component(&self, path: &Path, count: usize, kind: Option<&str>, choice: &ReadChoice) -> Result<()> {
        let has_luminance = count >= COLOURS && kind.is_none_or(|kind| MAY_BE_RGB.contains(&kind));
        let words = if has_luminance { "luminance or magnitude" } else { "or magnitude" };
        let known = format!("choose 0 to {}, {words}", count - 1);
        let (problem, remedy) = match choice.component {
            None if self.component.is_some() => (format!("is needed: each voxel has {count} values"), known),
            Some(Component::Number(0)) if self.component.is_none() => return Ok(()),
            Some(c) if self.component.is_none() => {
                (format!("is {c}, and each voxel has one value"), "leave it out".to_owned())
            }
            Some(Component::Number(n)) if n >= count => (format!("is {n}, and each voxel has {count} values"), known),
            Some(Component::Luminance) if !has_luminance => {
                let of = kind.map_or(String::new(), |kind| format!(" of kind {kind}"));
                (
                    format!("is luminance, and each voxel has {count} values{of}, which are not red, green and blue"),
                    known,
                )
            }
            _ => return Ok(()),
        };
        Err(Error::input(format!("{}: volume.component (--component)", path.display()), problem, remedy))
    }
}

/// Values that a colour has at the least.
const COLOURS: usize = 3;
/// Kinds of axes that may hold red, green and blue: many programs write colours as lists and vectors.
const MAY_BE_RGB: [&str; 9] =
    ["rgb-color", "rgba-color", "3-color", "4-color", "list", "vector", "3-vector", "4-vector", "domain"];
