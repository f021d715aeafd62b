//! The volume's box as the rasteriser gets it: its faces, clipped by the view, with caps where the near plane and clip planes cut
//! it, so that a camera inside the volume works.

use std::collections::HashMap;

use glam::DVec3;

/// A convex polygon; its corners in order around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    pub corners: Vec<usize>,
    /// Whether rays through the face enter the box by it.
    pub front: bool,
}

/// A convex polyhedron. Neighbouring faces share the very corners of their edge, so that no pixel is covered
/// twice or missed along it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyhedron {
    pub corners: Vec<DVec3>,
    pub faces: Vec<Face>,
}

/// The half space `normal . p >= distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    pub normal: DVec3,
    pub distance: f64,
}

impl HalfSpace {
    /// Height of a point over the plane, in lengths of the normal; negative outside.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.distance
    }
}

impl Polyhedron {
    /// The box [-half, half]; `enters` says whether rays enter a half space by its plane.
    pub fn cuboid(half: DVec3, enters: impl Fn(&HalfSpace) -> bool) -> Self {
        let corners = (0..8)
            .map(|i| half * DVec3::from_array(std::array::from_fn(|a| if i >> a & 1 == 1 { 1.0 } else { -1.0 })))
            .collect();
        let mut faces = Vec::with_capacity(6);
        for axis in 0..3 {
            let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
            for side in [0usize, 1] {
                let first = side << axis;
                let sign = if side == 1 { 1.0 } else { -1.0 };
                faces.push(Face {
                    corners: vec![first, first | u, first | u | v, first | v],
                    front: enters(&HalfSpace { normal: -sign * DVec3::AXES[axis], distance: -half[axis] }),
                });
            }
        }
        Self { corners, faces }
    }

    /// What of it lies in `space`. `cap`: whether the cut becomes a face, and then whether rays enter by it.
    pub fn clipped(&self, space: HalfSpace, cap: Option<bool>) -> Self {
        let height: Vec<f64> = self.corners.iter().map(|&c| space.height(c)).collect();
        if height.iter().all(|&h| h >= 0.0) {
            return self.clone();
        }
        let mut result = Self { corners: self.corners.clone(), faces: Vec::new() };
        // One new corner an edge, whichever face asks for it first.
        let mut cuts: HashMap<(usize, usize), usize> = HashMap::new();
        for face in &self.faces {
            let mut kept = Vec::new();
            for (i, &a) in face.corners.iter().enumerate() {
                let b = face.corners[(i + 1) % face.corners.len()];
                if height[a] >= 0.0 {
                    kept.push(a);
                }
                if (height[a] >= 0.0) != (height[b] >= 0.0) {
                    let (low, high) = (a.min(b), a.max(b));
                    kept.push(*cuts.entry((low, high)).or_insert_with(|| {
                        let weight = height[low] / (height[low] - height[high]);
                        result.corners.push(self.corners[low] + weight * (self.corners[high] - self.corners[low]));
                        result.corners.len() - 1
                    }));
                }
            }
            if kept.len() >= 3 {
                result.faces.push(Face { corners: kept, front: face.front });
            }
        }
        if let Some(front) = cap.filter(|_| cuts.len() >= 3) {
            let corners = around(space.normal, cuts.into_values().collect(), &result.corners);
            result.faces.push(Face { corners, front });
        }
        result
    }

    /// The corners of the triangles of all front (or back) faces, three each.
    pub fn triangles(&self, front: bool) -> Vec<DVec3> {
        let mut triangles = Vec::new();
        for face in self.faces.iter().filter(|f| f.front == front) {
            for i in 1..face.corners.len() - 1 {
                triangles.extend([0, i, i + 1].map(|c| self.corners[face.corners[c]]));
            }
        }
        triangles
    }
}

/// The points of a convex polygon in order around its middle.
fn around(normal: DVec3, mut indices: Vec<usize>, points: &[DVec3]) -> Vec<usize> {
    let middle = indices.iter().map(|&i| points[i]).sum::<DVec3>() / indices.len() as f64;
    let u = normal.any_orthogonal_vector().normalize();
    let v = normal.cross(u);
    let angle = |i: &usize| {
        let arm = points[*i] - middle;
        arm.dot(v).atan2(arm.dot(u))
    };
    indices.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    indices
}
