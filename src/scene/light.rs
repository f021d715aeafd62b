//! Lights, and what they make of a colour: the illumination model of Phong [Thesis §4.2.1].

use glam::{DQuat, DVec3};

use super::{Camera, Scene};

/// A light. Colours are linear, and hold how much of it takes part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    pub place: LightPlace,
    pub ambient: [f64; 3],
    pub diffuse: [f64; 3],
    pub specular: [f64; 3],
    /// The exponent of the specular part.
    pub shininess: f64,
}

/// Where a light is, in volume space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightPlace {
    /// Far away, in that direction of length 1.
    Direction(DVec3),
    Position(DVec3),
}

/// The headlight's part that shows where a surface is seen from the side, as that of polygons.
const HEADLIGHT_AMBIENT: f64 = 0.3;

/// A point of a surface, and from where it is seen.
#[derive(Clone, Copy, Debug)]
pub struct LitPoint {
    /// Volume space.
    pub place: DVec3,
    /// Normal of any length; none where there is none.
    pub normal: DVec3,
    /// Direction to the eye, of length 1.
    pub view: DVec3,
}

impl LitPoint {
    /// The normal of length 1, turned to the eye; none where there is none.
    pub fn turned(&self) -> Option<DVec3> {
        self.normal.try_normalize().map(|normal| if normal.dot(self.view) < 0.0 { -normal } else { normal })
    }
}

impl Light {
    /// A white light where the camera's rays come from: at the eye, or along the view.
    pub fn headlight(camera: &Camera) -> Self {
        let Camera { eye, target, .. } = *camera;
        Self {
            place: match camera.height {
                None => LightPlace::Position(eye),
                Some(_) => LightPlace::Direction((eye - target).normalize_or_zero()),
            },
            ambient: [HEADLIGHT_AMBIENT; 3],
            diffuse: [1.0 - HEADLIGHT_AMBIENT; 3],
            specular: [0.0; 3],
            shininess: 1.0,
        }
    }

    /// The same light in other axes.
    pub fn turned(self, turn: DQuat) -> Self {
        let place = match self.place {
            LightPlace::Direction(way) => LightPlace::Direction(turn * way),
            LightPlace::Position(point) => LightPlace::Position(turn * point),
        };
        Self { place, ..self }
    }

    /// The direction from a point to the light, of length 1; none of a light in that very point.
    pub fn from(&self, point: DVec3) -> Option<DVec3> {
        match self.place {
            LightPlace::Direction(way) => Some(way),
            LightPlace::Position(light) => (light - point).try_normalize(),
        }
    }

    /// How far it is from a point to the light; infinite where it is far away.
    pub fn distance(&self, point: DVec3) -> f64 {
        match self.place {
            LightPlace::Direction(_) => f64::INFINITY,
            LightPlace::Position(light) => light.distance(point),
        }
    }

    /// Whether it has no colour.
    pub fn is_white(&self) -> bool {
        let white = |[r, g, b]: [f64; 3]| r == g && g == b;
        white(self.ambient) && white(self.diffuse) && white(self.specular)
    }
}

/// What comes to a point of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arriving {
    /// The part that what stands between leaves of it, as a surface reflects it.
    pub clear: f64,
    /// The part that comes through what the surface encloses.
    pub through: f64,
}

impl Arriving {
    /// Light that nothing stands in the way of.
    pub const WHOLE: Self = Self { clear: 1.0, through: 1.0 };
}

/// A surface of that colour in all lights. Both of its sides are lit: its normal is turned to the eye. Without a normal, and by
/// a light in the point itself or behind the surface, it has the ambient part alone; the specular part does not take the
/// surface's colour, and is 0 where the diffuse one is [Thesis §4.2.1].
pub fn lit(color: [f64; 3], lights: &[Light], point: &LitPoint) -> [f64; 3] {
    lit_by(color, lights, point, 0.0, |_| Arriving::WHOLE)
}

/// The same where not all of the light arrives; `through` is the part of diffuse and specular colours that light which comes through
/// takes the place of. Such light shows as the surface's colour, from wherever it comes [Stegmaier05 §6].
pub fn lit_by(
    color: [f64; 3],
    lights: &[Light],
    point: &LitPoint,
    through: f64,
    mut arriving: impl FnMut(&Light) -> Arriving,
) -> [f64; 3] {
    let normal = point.turned();
    let mut sum = [0.0; 3];
    for light in lights {
        let facing = normal.zip(light.from(point.place)).map(|(n, way)| (n, way, n.dot(way)));
        let (diffuse, specular) = match facing {
            Some((normal, way, facing)) if facing > 0.0 => {
                let halfway = (way + point.view).normalize_or_zero();
                (facing, normal.dot(halfway).max(0.0).powf(light.shininess))
            }
            _ => (0.0, 0.0),
        };
        let arriving = arriving(light);
        for c in 0..3 {
            let reflected = arriving.clear * (color[c] * light.diffuse[c] * diffuse + light.specular[c] * specular);
            let come_through = color[c] * light.diffuse[c] * arriving.through;
            sum[c] += color[c] * light.ambient[c] + (1.0 - through) * reflected + through * come_through;
        }
    }
    sum
}

impl Scene {
    /// The lights that shine in the scene, in the volume's axes: on surfaces a headlight where none are given.
    pub fn shining(&self) -> Vec<Light> {
        if self.lights.is_empty() && self.surface.is_some() {
            vec![Light::headlight(&self.camera)]
        } else {
            self.lights.clone()
        }
    }
}
