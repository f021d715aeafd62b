//! Where the voxels of an NRRD file lie: how far apart, along which axes, in which order.

use std::path::Path;

use glam::{DQuat, DVec3};

use super::axes::{Axis, Direction};
use super::header::Header;
use super::roles::Roles;
use crate::error::{Error, Result};
use crate::read::ReadChoice;
use crate::read::orient::{self, Lie};
use crate::read::pick::{Combined, Picked};
use crate::scene::settings::Component;

/// Where the voxels of a volume are found in the file, and where they lie in volume space.
pub struct DataPlace {
    pub picked: Picked,
    pub spacing: [f64; 3],
    pub turn: DQuat,
    pub notes: Vec<String>,
    pub warnings: Vec<String>,
}

/// Two fields that give the same spacing may differ by this part of it: files are written with as few as four digits.
const ROUNDING: f64 = 1e-3;
/// Two ends of an axis may differ from what they stand for by this part of themselves.
const ROUNDING_OF_ENDS: f64 = 1e-6;

/// Spaces whose axes are left-handed, lower case; volume space is right-handed.
const LEFT_HANDED: [&str; 6] =
    ["left-anterior-superior", "las", "left-anterior-superior-time", "last", "3d-left-handed", "3d-left-handed-time"];

/// The third axis of a volume.
#[derive(Clone, Copy)]
enum Third {
    Axis(usize),
    /// The frames of a file of pictures, as slices.
    Slices(usize),
    /// A picture is one voxel thick.
    Thickness,
}

/// Where the voxels lie that are chosen of a file with these `roles`.
///
/// # Errors
/// When a spacing is 0 or infinite, or fields contradict each other.
pub fn place(path: &Path, header: &Header, roles: &Roles, choice: &ReadChoice) -> Result<DataPlace> {
    let axes = &header.axes;
    let (mut notes, mut warnings) = (Vec::new(), Vec::new());
    let third = match (roles.space.get(2), roles.frame) {
        (Some(axis), _) => Third::Axis(*axis),
        (None, Some(axis)) if choice.frame.is_none() => Third::Slices(axis),
        _ => Third::Thickness,
    };
    let plane = [roles.space[0], roles.space[1]];
    let mut spacing = [1.0; 3];
    for (side, axis) in spacing.iter_mut().zip(plane) {
        *side = spacing_of(path, axes, axis, &mut warnings)?.unwrap_or(1.0);
    }
    let finest = spacing[0].min(spacing[1]);
    spacing[2] = match third {
        Third::Axis(axis) => spacing_of(path, axes, axis, &mut warnings)?.unwrap_or(1.0),
        // Seconds are no distance.
        Third::Slices(axis) if axes[axis].kind.as_deref() == Some("time") => finest,
        Third::Slices(axis) => spacing_of(path, axes, axis, &mut warnings)?.unwrap_or(finest),
        Third::Thickness => finest,
    };
    match third {
        Third::Axis(_) => {}
        Third::Slices(axis) => notes.push(format!(
            "the file holds {} pictures (axis {axis} is not in space), which are read as the slices of one volume, {} apart; \
             --frame picks one",
            axes[axis].size, spacing[2]
        )),
        Third::Thickness => notes.push("the file holds a picture, which is read as a volume one voxel thick".into()),
    }
    let left_handed = header.space.as_deref().filter(|space| LEFT_HANDED.contains(space));
    let lie = match directions(axes, plane, third) {
        Some(directions) => orient::lie(directions, left_handed.is_some(), choice.orientation),
        None => Lie { mirrored: left_handed.is_some(), ..Lie::OWN },
    };
    let unknown = |axis: &usize| axes[*axis].direction == Direction::Unknown;
    if let Some(axis) = plane.into_iter().chain(third.axis()).find(unknown) {
        notes.push(format!(
            "`space directions` do not say how axis {axis} lies (nan): the volume is drawn along its own axes"
        ));
    }
    notes.extend(lie.note.clone());
    warnings.extend(lie.warning.clone());
    if lie.mirrored {
        let why = match left_handed {
            Some(space) => format!("`space` is {space}"),
            None => "the axes it is drawn along are left-handed in `space directions`".to_owned(),
        };
        warnings.push(format!("the picture shows the volume mirrored: {why}, and pictures are right-handed"));
    }
    let picked = picked(axes, roles, choice, [Some(plane[0]), Some(plane[1]), third.axis()], &lie);
    Ok(DataPlace { picked, spacing: lie.axes.map(|(axis, _)| spacing[axis]), turn: lie.turn, notes, warnings })
}

impl Third {
    fn axis(self) -> Option<usize> {
        match self {
            Self::Axis(axis) | Self::Slices(axis) => Some(axis),
            Self::Thickness => None,
        }
    }
}

/// The directions of the three axes; none where not all are known.
fn directions(axes: &[Axis], plane: [usize; 2], third: Third) -> Option<[DVec3; 3]> {
    let known = |axis: usize| match axes[axis].direction {
        Direction::Known(direction, _) => Some(direction),
        _ => None,
    };
    let [x, y] = [known(plane[0])?, known(plane[1])?];
    // Pictures lie square to the plane they span; scaled, since a product of two lengths may overflow.
    let square = || (x / x.abs().max_element()).cross(y / y.abs().max_element());
    let z = match third {
        Third::Axis(axis) => known(axis)?,
        // Seconds are no direction.
        Third::Slices(axis) if axes[axis].kind.as_deref() == Some("time") => square(),
        Third::Slices(axis) => known(axis).unwrap_or_else(square),
        Third::Thickness => square(),
    };
    Some([x, y, z])
}

/// Where the values of the voxels are found, with the axes as they lie.
fn picked(axes: &[Axis], roles: &Roles, choice: &ReadChoice, own: [Option<usize>; 3], lie: &Lie) -> Picked {
    let mut steps = vec![1isize];
    for axis in axes {
        steps.push(steps[steps.len() - 1].saturating_mul(axis.size as isize));
    }
    let mut picked = Picked { first: 0, steps: [0; 3], dims: [1; 3], combined: None };
    for (side, (axis, mirrored)) in lie.axes.into_iter().enumerate() {
        let Some(axis) = own[axis] else { continue };
        let (size, step) = (axes[axis].size, steps[axis]);
        picked.dims[side] = size;
        picked.steps[side] = if mirrored { -step } else { step };
        picked.first += if mirrored { (size as isize - 1) * step } else { 0 };
    }
    if let (Some(axis), Some(frame)) = (roles.frame, choice.frame) {
        picked.first += frame as isize * steps[axis];
    }
    match (roles.component, choice.component) {
        (Some(axis), Some(Component::Number(n))) => picked.first += n as isize * steps[axis],
        (Some(axis), Some(by)) => {
            picked.combined = Some(Combined { by, count: axes[axis].size, step: steps[axis] });
        }
        _ => {}
    }
    picked
}

/// The distance of samples along an axis; none where it is unknown.
fn spacing_of(path: &Path, axes: &[Axis], at: usize, warnings: &mut Vec<String>) -> Result<Option<f64>> {
    let axis = &axes[at];
    let bad =
        |problem: String, remedy: &str| Err(Error::input(format!("{}: spacing", path.display()), problem, remedy));
    let direction = match axis.direction {
        Direction::Known(_, length) => Some(("`space directions`", length)),
        _ => None,
    };
    let spacing = axis.spacing.map(|spacing| ("`spacings`", spacing));
    let ends = by_ends(axis, direction.or(spacing).map(|(_, stated)| stated));
    let ends = ends.map(|ends| ("`axis mins` and `axis maxs`", ends));
    let given: Vec<(&str, f64)> = [direction, spacing, ends].into_iter().flatten().collect();
    let Some((field, chosen)) = given.first().copied() else { return Ok(None) };
    for (other, value) in &given {
        if !value.is_finite() || *value == 0.0 {
            let remedy = "give finite spacings other than 0, or nan";
            return bad(format!("along axis {at} is {value} by {other}"), remedy);
        }
        let slack = if ends.is_some_and(|(ends, _)| ends == *other) { ends_slack(axis) } else { 0.0 };
        if (value.abs() - chosen.abs()).abs() > ROUNDING * chosen.abs().max(value.abs()) + slack {
            let problem = format!("along axis {at} is {} by {field}, but {} by {other}", chosen.abs(), value.abs());
            return bad(problem, "remove the field that is wrong");
        }
    }
    for (field, value) in given.iter().filter(|(_, value)| *value < 0.0) {
        warnings.push(format!(
            "{field} give axis {at} the negative spacing {value}: its size counts, and the axis is not reversed"
        ));
    }
    Ok(Some(chosen.abs()))
}

/// The spacing by the ends of an axis: (max - min) / size where samples are centred in cells, (max - min) / (size - 1) where
/// they are nodes. The format has no default; cells are ours, but for a file whose other fields (`stated`) tell nodes.
fn by_ends(axis: &Axis, stated: Option<f64>) -> Option<f64> {
    let length = axis.max? - axis.min?;
    // One sample at one place: a node, as far as anyone knows.
    if axis.size == 1 && axis.node.is_none() && length == 0.0 {
        return None;
    }
    let cell = length / axis.size as f64;
    let node = (axis.size > 1).then(|| length / (axis.size - 1) as f64);
    match (axis.node, stated) {
        (Some(true), _) => node,
        (None, Some(stated)) => Some([Some(cell), node].into_iter().flatten().fold(cell, |best, spacing| {
            let off = |spacing: f64| (spacing.abs() - stated.abs()).abs();
            if off(spacing) < off(best) { spacing } else { best }
        })),
        _ => Some(cell),
    }
}

/// What rounding of the ends of an axis makes of its spacing.
fn ends_slack(axis: &Axis) -> f64 {
    let farthest = axis.min.unwrap_or(0.0).abs().max(axis.max.unwrap_or(0.0).abs());
    ROUNDING_OF_ENDS * farthest / axis.size as f64
}
