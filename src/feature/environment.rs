//! What iso-surfaces reflect [Thesis §4.3].

use super::surface::{is_drawn, is_lit};
use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::rows::{Feature, Hook, Why};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::Mapping;

/// Surfaces that reflect a picture of what is around them, as the lighting pass has it.
pub const ENVIRONMENT: Feature = Feature {
    with: Some("ENVIRONMENT"),
    constants: |context| context.scene.environment.iter().map(|environment| mapping(environment.mapping)).collect(),
    reads: |_| vec![resource::ENVIRONMENT, resource::ENVIRONMENT_PLACE],
    ..Feature::at(Hook::Light, "environment", |context| match &context.scene.environment {
        Some(_) if !is_drawn(context) => Err(Why::Untold),
        Some(_) if !is_lit(context) => Err("places and normals of surfaces show, which reflect nothing".into()),
        Some(environment) if context.plans() && environment.reflectivity == 0.0 => Err("reflectivity is 0".into()),
        Some(_) => Ok(()),
        None => Err(Why::Untold),
    })
};

/// Of `environment.glsl`: which direction each place of the picture shows.
fn mapping(mapping: Mapping) -> Constant {
    let code = match mapping {
        Mapping::Latlong => 0,
        Mapping::Sphere => 1,
    };
    ("MAPPING", code)
}

/// Whether a scene's environment has something to be reflected by.
///
/// # Errors
/// When it has not.
pub fn check(scene: &Scene) -> Result<()> {
    if scene.environment.is_none() || scene.surface.is_some() {
        return Ok(());
    }
    Err(Error::usage(
        "environment (--environment)",
        "is what iso-surfaces reflect, and the scene has none",
        "add one (--iso VALUE, or [surface]), or leave the environment out",
    ))
}
