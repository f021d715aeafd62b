//! Built-in scenes: what the papers show in figures, complete in itself, each a scene file's text.
//!
//! **To add a scene**: its text here, its row in [`ALL`]. `depthleap reproduce` then shows its picture, and one of each form
//! of it on a volume of the user's. Figures that have no built-in form stand in [`STEGMAIER`].

mod stegmaier;

pub use stegmaier::{PaperFigure, STEGMAIER};

/// A scene that needs no file.
#[derive(Clone, Copy, Debug)]
pub struct BuiltinScene {
    /// It is given as `builtin:NAME`, as a volume is.
    pub name: &'static str,
    /// One line for `--help` and reports.
    pub about: &'static str,
    /// The figure whose like it is.
    pub source: &'static str,
    /// The text of its scene file.
    pub text: &'static str,
    /// The same on volumes that are not built in.
    pub on_data: &'static [SceneOnData],
}

/// A scene of a volume that is a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneOnData {
    /// The name in reports and of picture files.
    pub name: &'static str,
    /// One line for reports: what is to be seen.
    pub about: &'static str,
    /// The volume, as the text names it.
    pub file: &'static str,
    /// The text of its scene file, which stands beside the volume.
    pub text: &'static str,
}

/// The CT scan of an engine block.
pub const ENGINE: SceneOnData = SceneOnData {
    name: "engine-on-data",
    about: "an engine block with a transparent green sphere in it and an arrow through that",
    file: "engine_256cube.nrrd",
    text: include_str!("engine-on-data.toml"),
};

/// The CT scan of a foot.
pub const FOOT: SceneOnData = SceneOnData {
    name: "foot-on-data",
    about: "a foot with a transparent blue sphere in it and a green arrow behind that",
    file: "foot_cadaver.nrrd",
    text: include_str!("foot-on-data.toml"),
};

/// A jet of fuel.
pub const FUEL: SceneOnData = SceneOnData {
    name: "fuel-on-data",
    about: "a jet of fuel in a transparent blue sphere, with a transparent green arrow across",
    file: "fuel.nrrd",
    text: include_str!("fuel-on-data.toml"),
};

/// An MRI scan of a head.
const HEAD: SceneOnData = SceneOnData {
    name: "head-on-data",
    about: "a head with a sphere cut out of it",
    file: "mri_head.nrrd",
    text: include_str!("head-on-data.toml"),
};

/// The same head, as the thesis cuts.
const HEAD_BEHIND: SceneOnData = SceneOnData {
    name: "head-behind-on-data",
    about: "a head, cut in front of the first surface of a sphere",
    file: "mri_head.nrrd",
    text: include_str!("head-behind-on-data.toml"),
};

/// A head in two lights.
const TWO_LIGHTS: SceneOnData = SceneOnData {
    name: "two-lights-on-data",
    about: "a head lit by a red light at the upper left and a blue one at the lower right",
    file: "mri_head.nrrd",
    text: include_str!("two-lights-on-data.toml"),
};

/// Every built-in scene.
pub const ALL: [BuiltinScene; 4] = [
    BuiltinScene {
        name: "engine-geometry",
        about: "an engine-like block with a transparent green sphere in it and an arrow through that",
        source: "Thesis ch. 6, Figure 3",
        text: include_str!("engine-geometry.toml"),
        on_data: &[ENGINE, FOOT],
    },
    BuiltinScene {
        name: "head-clipped",
        about: "a head-like shell with a sphere cut out of it",
        source: "Thesis ch. 6, Figure 4",
        text: include_str!("head-clipped.toml"),
        on_data: &[HEAD, HEAD_BEHIND],
    },
    BuiltinScene {
        name: "two-lights",
        about: "a head-like shell lit by a red light at the upper left and a blue one at the lower right",
        source: "Thesis ch. 7, Figure 8",
        text: include_str!("two-lights.toml"),
        on_data: &[TWO_LIGHTS],
    },
    BuiltinScene {
        name: "reflecting-torus",
        about: "a torus that reflects the six spheres around it",
        source: "Thesis ch. 4, Figure 5",
        text: include_str!("reflecting-torus.toml"),
        on_data: &[],
    },
];

/// The built-in scene of that name.
pub fn find(name: &str) -> Option<&'static BuiltinScene> {
    static TABLE: [BuiltinScene; ALL.len()] = ALL;
    TABLE.iter().find(|scene| scene.name == name)
}
