//! What effects of a scene need of its surfaces.

use super::Scene;
use super::settings::Translucency;

impl Scene {
    /// How far in front of a surface its ways to lights begin, in volume units; none where surfaces cast no shadows.
    pub fn shadow_bias(&self) -> Option<f64> {
        let effects = &self.settings.effects;
        (effects.shadows && self.surface.is_some()).then(|| effects.shadow_bias * self.field.finest())
    }

    /// How light comes through what surfaces enclose; none where they are not translucent.
    pub fn translucency(&self) -> Option<Translucency> {
        self.settings.effects.translucency.filter(|_| self.surface.is_some())
    }
}
