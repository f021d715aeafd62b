//! An engine block: a casting on a flange, with bores and their liners, a tunnel and bolts.

use glam::DVec3;

use super::profile::{Local, cuboid, cylinder};

/// Depth over which each surface rises.
const RISE: f64 = 0.05;
/// Densities of the casting, and of liners and bolts in it.
const CASTING: f64 = 0.45;
const STEEL: f64 = 1.0;

/// Centre and half sides of the casting and of the flange below it.
const CASTING_BOX: [DVec3; 2] = [DVec3::new(0.0, 0.05, 0.0), DVec3::new(0.75, 0.55, 0.45)];
const FLANGE_BOX: [DVec3; 2] = [DVec3::new(0.0, -0.5, 0.0), DVec3::new(0.88, 0.12, 0.6)];

/// Where the bores stand on x; they are open above.
const BORES: [f64; 2] = [-0.36, 0.36];
const BORE_RADIUS: f64 = 0.22;
const LINER_RADIUS: f64 = 0.32;
/// The bores end at this y.
const BORE_BOTTOM: f64 = -0.25;

/// The tunnel of the shaft along x: its y, its radius.
const TUNNEL: [f64; 2] = [-0.42, 0.15];

/// Where the bolts stand, on x (either side) and z (either side), their radius.
const BOLTS: [f64; 3] = [0.62, 0.3, 0.09];

/// The block at p.
pub fn engine(p: DVec3) -> Local {
    let [casting, flange] = [CASTING_BOX, FLANGE_BOX].map(|[centre, half]| cuboid(p, centre, half, RISE));
    // Above the bottom of the bores, and beyond the casting's top.
    let above = cuboid(p, DVec3::new(0.0, BORE_BOTTOM + 1.0, 0.0), DVec3::new(2.0, 1.0, 2.0), RISE);
    let upright = |x: f64, radius: f64| cylinder(p, DVec3::new(x, 0.0, 0.0), DVec3::Y, radius, RISE);
    let [bores, liners] =
        [BORE_RADIUS, LINER_RADIUS].map(|radius| upright(BORES[0], radius).or(upright(BORES[1], radius)) * above);
    let tunnel = cylinder(p, DVec3::new(0.0, TUNNEL[0], 0.0), DVec3::X, TUNNEL[1], RISE);
    // One bolt at each of four corners.
    let [x, z, radius] = BOLTS;
    let corner = DVec3::new(x * p.x.signum(), 0.0, z * p.z.signum());
    let bolts = cylinder(p, corner, DVec3::Y, radius, RISE);
    let solid = casting.or(flange) * bores.outside() * tunnel.outside();
    CASTING * solid + (STEEL - CASTING) * (solid * liners.or(bolts))
}
