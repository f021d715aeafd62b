//! How a volume lies in its file's space: as an order and a mirroring of its axes, which voxels follow exactly, and a
//! rotation that is left, which the camera undoes.

use glam::{DMat3, DQuat, DVec3};

use crate::scene::settings::Orientation;

/// The most that the cosine of two axes' angle may be for them to count as square to each other (0.06 degrees): files
/// round directions to as few as four digits, while scanners tilt by whole degrees.
const SQUARE: f64 = 1e-3;
/// A rotation by less (radians) is a rounding of the file's numbers, and none.
const LEAST_TURN: f64 = 1e-6;

/// What is done with a volume for it to lie as its file says.
#[derive(Clone, Debug, PartialEq)]
pub struct Lie {
    /// The file's axis that becomes x, y and z, and whether it is mirrored.
    pub axes: [(usize, bool); 3],
    pub turn: DQuat,
    /// Whether it is shown mirrored: by axes of another hand than the file's space has.
    pub mirrored: bool,
    pub note: Option<String>,
    pub warning: Option<String>,
}

impl Lie {
    /// Along its own axes.
    pub const OWN: Self = Self {
        axes: [(0, false), (1, false), (2, false)],
        turn: DQuat::IDENTITY,
        mirrored: false,
        note: None,
        warning: None,
    };
}

/// How a volume lies whose axes have these directions, of any length but 0, in a space that may be left-handed.
pub fn lie(directions: [DVec3; 3], left_handed: bool, orientation: Orientation) -> Lie {
    let units = directions.map(unit);
    let turned_over = units[0].cross(units[1]).dot(units[2]) < 0.0;
    let own = Lie { mirrored: turned_over != left_handed, ..Lie::OWN };
    let cosines = [(0, 1), (0, 2), (1, 2)].map(|(a, b)| (a, b, units[a].dot(units[b])));
    if let Some((a, b, cosine)) = cosines.into_iter().find(|(.., cosine)| cosine.abs() > SQUARE) {
        let angle = cosine.clamp(-1.0, 1.0).acos().to_degrees();
        let warning = format!(
            "`space directions` are sheared (axes {a} and {b} meet at {angle:.1} degrees): the volume is drawn along its \
             own axes, as if they were square to each other"
        );
        return Lie { warning: Some(warning), ..own };
    }
    let units = DMat3::from_cols(units[0], units[1], units[2]);
    let axes = nearest(&units);
    let turn = left_over(&units, axes);
    let Some(what) = in_words(axes, turn) else { return own };
    match orientation {
        Orientation::File => {
            let note = format!("the volume is drawn as `space directions` say (orientation = file): {what}");
            Lie { axes, turn, mirrored: left_handed, note: Some(note), ..Lie::OWN }
        }
        Orientation::Index => {
            let note =
                format!("the volume is drawn along its own axes (orientation = index); `space directions` say: {what}");
            Lie { note: Some(note), ..own }
        }
    }
}

/// Of length 1, also where the square of the length overflows.
fn unit(direction: DVec3) -> DVec3 {
    let scaled = direction / direction.abs().max_element();
    scaled / scaled.length()
}

/// The six orders of three axes.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Of the orders and mirrorings of the axes that are as left-handed as `units` are, the nearest to them.
fn nearest(units: &DMat3) -> [(usize, bool); 3] {
    let mut best = (f64::NEG_INFINITY, Lie::OWN.axes);
    for (order, signs) in ORDERS.into_iter().flat_map(|order| (0..8).map(move |signs| (order, signs))) {
        let axes = [0, 1, 2].map(|row| (order[row], signs >> row & 1 == 1));
        let trace: f64 = (0..3).map(|row| sign(axes[row].1) * units.col(axes[row].0)[row]).sum();
        if matrix(axes).determinant() * units.determinant() > 0.0 && trace > best.0 {
            best = (trace, axes);
        }
    }
    best.1
}

fn sign(mirrored: bool) -> f64 {
    if mirrored { -1.0 } else { 1.0 }
}

/// The signed permutation P: its column a is where the file's axis a goes.
fn matrix(axes: [(usize, bool); 3]) -> DMat3 {
    let mut matrix = DMat3::ZERO;
    for (row, (axis, mirrored)) in axes.into_iter().enumerate() {
        matrix.col_mut(axis)[row] = sign(mirrored);
    }
    matrix
}

/// The rotation R = U P^T that is left of the directions U, made square.
fn left_over(units: &DMat3, axes: [(usize, bool); 3]) -> DQuat {
    let rest = *units * matrix(axes).transpose();
    let x = rest.col(0).normalize();
    let z = x.cross(rest.col(1)).normalize();
    let turn = DQuat::from_mat3(&DMat3::from_cols(x, z.cross(x), z)).normalize();
    if turn.angle_between(DQuat::IDENTITY) < LEAST_TURN { DQuat::IDENTITY } else { turn }
}

/// None where nothing is done.
fn in_words(axes: [(usize, bool); 3], turn: DQuat) -> Option<String> {
    let mut done = Vec::new();
    if axes.map(|(axis, _)| axis) != [0, 1, 2] {
        let [x, y, z] = axes.map(|(axis, _)| axis);
        done.push(format!("axes {x}, {y} and {z} of its voxels as x, y and z"));
    }
    let mirrored: Vec<_> = axes.iter().filter(|(_, mirrored)| *mirrored).map(|(axis, _)| axis.to_string()).collect();
    if !mirrored.is_empty() {
        done.push(format!("reversed along axis {}", mirrored.join(" and axis ")));
    }
    if turn != DQuat::IDENTITY {
        done.push(format!("turned by {:.3} degrees", turn.angle_between(DQuat::IDENTITY).to_degrees()));
    }
    (!done.is_empty()).then(|| done.join(", "))
}
