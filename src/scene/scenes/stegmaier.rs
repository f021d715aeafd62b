//! Figures of [Stegmaier05] on volumes of the user's: bucky ball, engine and Lucy, by its single pass.

/// A figure of a paper, on a volume that is a file.
#[derive(Clone, Copy, Debug)]
pub struct PaperFigure {
    /// The name in reports and of picture files.
    pub name: &'static str,
    /// One line for reports: what is to be seen.
    pub about: &'static str,
    /// The figure whose like it is.
    pub source: &'static str,
    /// The volume or the mesh, as the text names it.
    pub file: &'static str,
    /// The text of its scene file, which stands beside the volume.
    pub text: &'static str,
}

/// The text of a scene file, of parts that stand in the folder `stegmaier`.
macro_rules! parts {
    ($($part:literal),*) => {
        concat!($(include_str!(concat!("stegmaier/", $part, ".toml"))),*)
    };
}

const fn bucky(name: &'static str, about: &'static str, text: &'static str) -> PaperFigure {
    PaperFigure { name, about, source: "Stegmaier05, Figure 7", file: "buckyball.nrrd", text }
}

const fn lucy(name: &'static str, about: &'static str, text: &'static str) -> PaperFigure {
    PaperFigure { name, about, source: "Stegmaier05, Figure 1", file: "lucy_decimated.ply", text }
}

const fn engine(name: &'static str, source: &'static str, about: &'static str, text: &'static str) -> PaperFigure {
    PaperFigure { name, about, source, file: "engine.nrrd", text }
}

/// Every such figure, in the order of the paper's.
pub const STEGMAIER: [PaperFigure; 19] = [
    lucy(
        "stegmaier-1-lucy-translucent",
        "a statue of a translucent material, lit from behind",
        parts!("lucy", "statue-translucent"),
    ),
    lucy(
        "stegmaier-1-lucy-transparent",
        "a statue whose surface lets something through",
        parts!("lucy", "statue-transparent", "lit"),
    ),
    lucy(
        "stegmaier-1-lucy-refracting",
        "a statue that refracts what is behind it",
        parts!("lucy", "statue-refracting"),
    ),
    lucy(
        "stegmaier-1-lucy-reflecting",
        "a statue that reflects what is around it, there a light probe",
        parts!("lucy", "statue", "reflecting"),
    ),
    engine(
        "stegmaier-1-reflecting",
        "Stegmaier05, Figure 1, there Lucy in a light probe",
        "the engine, reflecting a sky",
        parts!("engine", "surface", "reflecting"),
    ),
    engine(
        "stegmaier-5-volume",
        "Stegmaier05, Figure 5",
        "the engine, semi-transparent by a transfer function, pre-integrated",
        parts!("engine", "volume"),
    ),
    engine(
        "stegmaier-5-mip",
        "Stegmaier05, Figure 5",
        "the engine's greatest value along each ray",
        parts!("engine", "mip"),
    ),
    engine(
        "stegmaier-5-surface-in-volume",
        "Stegmaier05, Figure 5",
        "an opaque iso-surface in the semi-transparent engine",
        parts!("engine", "surface-in-volume", "lit"),
    ),
    engine(
        "stegmaier-5-transparent",
        "Stegmaier05, Figure 5",
        "semi-transparent iso-surfaces of the engine",
        parts!("engine", "transparent", "lit"),
    ),
    engine(
        "stegmaier-6-surface",
        "Stegmaier05, Figure 6, without its effects",
        "an opaque iso-surface of the engine, lit",
        parts!("engine", "surface", "lit"),
    ),
    engine(
        "stegmaier-6-shadows",
        "Stegmaier05, Figure 6",
        "an iso-surface of the engine that throws shadows on itself",
        parts!("engine", "surface", "shadows", "lit"),
    ),
    engine(
        "stegmaier-6-clipped",
        "Stegmaier05, Figure 6",
        "an iso-surface of the engine, clipped by a sphere, the iso-surface of a radial field",
        parts!("engine", "surface", "lit", "sphere"),
    ),
    engine(
        "stegmaier-6-plane",
        "Stegmaier05, Figure 6, there a sphere",
        "an iso-surface of the engine, cut by a plane",
        parts!("engine", "surface", "lit", "plane"),
    ),
    engine(
        "stegmaier-6-translucent",
        "Stegmaier05, Figure 6",
        "the engine of a translucent material",
        parts!("engine", "translucent"),
    ),
    engine(
        "stegmaier-6-refracting",
        "Stegmaier05, Figure 6",
        "the engine of a material that refracts what is behind it",
        parts!("engine", "refracting"),
    ),
    bucky(
        "stegmaier-7-reflecting-none",
        "the bucky ball, about 50 samples across, each place of its surface a sample, reflecting a sky",
        parts!("bucky", "bucky-none", "reflecting"),
    ),
    bucky(
        "stegmaier-7-reflecting-linear",
        "the same, each place interpolated linearly between two samples",
        parts!("bucky", "bucky-linear", "reflecting"),
    ),
    bucky(
        "stegmaier-7-normals-none",
        "the bucky ball, about 50 samples across, each place of its surface a sample, its normals as colours",
        parts!("bucky", "bucky-none", "normals"),
    ),
    bucky(
        "stegmaier-7-normals-linear",
        "the same normals, each place interpolated linearly between two samples",
        parts!("bucky", "bucky-linear", "normals"),
    ),
];
