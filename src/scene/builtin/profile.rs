//! Profiles that built-in volumes are made of, and solids that join, cut and fill each other, each with its derivative.

use std::ops::{Add, Mul};

use glam::DVec3;

/// (1 - s)^3 below s = 1, 0 beyond, for s = (distance / half width)^2.
pub fn bump(s: f64) -> f64 {
    (1.0 - s).max(0.0).powi(3)
}

/// Derivative of [`bump`] after s.
pub fn bump_slope(s: f64) -> f64 {
    -3.0 * (1.0 - s).max(0.0).powi(2)
}

/// 0 below 0, 1 above 1, 6 t^5 - 15 t^4 + 10 t^3 between.
pub fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t.powi(3) * (t * (6.0 * t - 15.0) + 10.0)
}

/// Derivative of [`smoothstep`] after t.
pub fn smoothstep_slope(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    30.0 * (t * (1.0 - t)).powi(2)
}

/// A scalar function at a point, with its gradient there.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    pub value: f64,
    pub gradient: DVec3,
}

impl Local {
    /// 1 where this is 0 and 0 where this is 1: what is outside of a solid.
    pub fn outside(self) -> Self {
        Self { value: 1.0 - self.value, gradient: -self.gradient }
    }

    /// In either of two solids.
    pub fn or(self, other: Self) -> Self {
        (self.outside() * other.outside()).outside()
    }
}

impl Add for Local {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, gradient: self.gradient + other.gradient }
    }
}

/// The product: in both of two solids.
impl Mul for Local {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, gradient: self.value * other.gradient + other.value * self.gradient }
    }
}

impl Mul<Local> for f64 {
    type Output = Local;

    fn mul(self, of: Local) -> Local {
        Local { value: self * of.value, gradient: self * of.gradient }
    }
}

/// A solid whose surface lies where `depth` is 0: from there inwards the value rises from 0 to 1 over the depth `rise`.
pub fn solid(depth: Local, rise: f64) -> Local {
    let t = depth.value / rise;
    Local { value: smoothstep(t), gradient: smoothstep_slope(t) / rise * depth.gradient }
}

/// A box about `centre`.
pub fn cuboid(p: DVec3, centre: DVec3, half: DVec3, rise: f64) -> Local {
    let d = p - centre;
    let slab = |axis: DVec3| {
        let depth = half.dot(axis) - d.dot(axis).abs();
        solid(Local { value: depth, gradient: -d.dot(axis).signum() * axis }, rise)
    };
    slab(DVec3::X) * slab(DVec3::Y) * slab(DVec3::Z)
}

/// A cylinder without ends about the line through `centre` along `axis`, one of the three.
pub fn cylinder(p: DVec3, centre: DVec3, axis: DVec3, radius: f64, rise: f64) -> Local {
    let across = (p - centre) * (DVec3::ONE - axis);
    let outward = across.try_normalize().unwrap_or(DVec3::ZERO);
    solid(Local { value: radius - across.length(), gradient: -outward }, rise)
}

/// An ellipsoid about `centre` with these half axes; `rise` is a part of them.
pub fn ellipsoid(p: DVec3, centre: DVec3, half: DVec3, rise: f64) -> Local {
    let scaled = (p - centre) / half;
    let outward = scaled.try_normalize().unwrap_or(DVec3::ZERO) / half;
    solid(Local { value: 1.0 - scaled.length(), gradient: -outward }, rise)
}
