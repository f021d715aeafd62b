//! Distances of the host that are updated where only the transfer function is another one.

use crate::resource::texels::Texels;
use crate::scene::Scene;
use crate::structure::Lookup;
use crate::structure::update::Updatable;

/// Distances of one scene and one look-up at a time, where they are asked for.
#[derive(Default)]
pub(super) struct Following {
    asked: bool,
    distances: Option<Updatable>,
}

impl Following {
    /// Keeps distances from now on.
    pub fn ask(&mut self) {
        self.asked = true;
    }

    /// Forgets the scene.
    pub fn forget(&mut self) {
        self.distances = None;
    }

    /// The bytes of the distances that are looked up in the scene, which differs from the last one in its transfer function at the
    /// most; none where nobody asked, or they are made for a view.
    pub fn distances(&mut self, scene: &Scene, lookup: &Lookup) -> Option<&[u8]> {
        if !self.asked || lookup.view.is_some() {
            return None;
        }
        let texels = Texels::of(scene);
        let shown = texels.shown(scene);
        match &mut self.distances {
            Some(kept) if kept.lookup() == lookup => kept.update(&scene.field, &texels.values, &shown),
            kept => *kept = Updatable::new(&scene.field, &texels.values, &shown, lookup),
        }
        self.distances.as_ref().map(|kept| &kept.distances().bytes[..])
    }
}
