//! The render methods, what near-neighbor skipping measures along, and how fragments are culled and marked.

use serde::{Deserialize, Serialize};

/// The render methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    /// Ray casting without acceleration [KW03 §2.1].
    Rc,
    /// Ray casting with early ray termination by early z [KW03 §2.1].
    RcErt,
    /// `rc-ert` with skipping of empty 8^3 blocks [KW03 §2.3].
    RcBlock,
    /// Near-neighbor skipping, distance in any direction [Thesis §5.3].
    NnOmni,
    /// Distance within the octant of the fragment's ray [Thesis §5.3.1].
    NnDirectional,
    /// Distance along the rays of this view [Thesis §5.3.1].
    NnOptimal,
    /// Distance within a cone around this view's rays, good for cameras nearby [Thesis §5.7].
    NnCone,
    /// `nn-omni`, intermediate passes after the first merged into the main passes [Thesis §5.7].
    #[serde(rename = "nn-omni+fused")]
    #[value(name = "nn-omni+fused")]
    NnOmniFused,
    /// `nn-directional`, its passes merged in the same way.
    #[serde(rename = "nn-directional+fused")]
    #[value(name = "nn-directional+fused")]
    NnDirectionalFused,
    /// `nn-optimal`, its passes merged in the same way.
    #[serde(rename = "nn-optimal+fused")]
    #[value(name = "nn-optimal+fused")]
    NnOptimalFused,
    /// `nn-cone`, its passes merged in the same way.
    #[serde(rename = "nn-cone+fused")]
    #[value(name = "nn-cone+fused")]
    NnConeFused,
    /// The f64 reference: the same sum, on the CPU.
    Cpu,
}

/// What near-neighbor skipping measures its distances along [Thesis §5.3.1, §5.7].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Distance {
    /// Any direction.
    Omni,
    /// The directions of an octant.
    Directional,
    /// The rays of one view.
    Optimal,
    /// Directions near the rays of one view.
    Cone,
}

impl Distance {
    pub fn name(self) -> &'static str {
        match self {
            Self::Omni => "omni",
            Self::Directional => "directional",
            Self::Optimal => "optimal",
            Self::Cone => "cone",
        }
    }
}

/// What a method is, beside its steps.
struct Row {
    method: MethodName,
    /// As on the command line, in files and in reports.
    name: &'static str,
    /// Whether rays end before they leave the volume, once their opacity is above T.
    ends_rays: bool,
    /// Whether empty blocks of cells are skipped.
    blocks: bool,
    /// The distances it reads.
    distance: Option<Distance>,
    /// Whether main passes decide where the ray goes on.
    fused: bool,
    /// Whether it runs on a device; else in f64 on the CPU.
    on_device: bool,
}

impl Row {
    const fn new(method: MethodName, name: &'static str) -> Self {
        Self { method, name, ends_rays: true, blocks: false, distance: None, fused: false, on_device: true }
    }

    const fn near_neighbor(method: MethodName, name: &'static str, distance: Distance, fused: bool) -> Self {
        Self { distance: Some(distance), fused, ..Self::new(method, name) }
    }
}

/// What the methods are, in the order of [`MethodName`].
const ROWS: [Row; 12] = {
    use Distance::{Cone, Directional, Omni, Optimal};
    use MethodName as M;
    [
        Row { ends_rays: false, ..Row::new(M::Rc, "rc") },
        Row::new(M::RcErt, "rc-ert"),
        Row { blocks: true, ..Row::new(M::RcBlock, "rc-block") },
        Row::near_neighbor(M::NnOmni, "nn-omni", Omni, false),
        Row::near_neighbor(M::NnDirectional, "nn-directional", Directional, false),
        Row::near_neighbor(M::NnOptimal, "nn-optimal", Optimal, false),
        Row::near_neighbor(M::NnCone, "nn-cone", Cone, false),
        Row::near_neighbor(M::NnOmniFused, "nn-omni+fused", Omni, true),
        Row::near_neighbor(M::NnDirectionalFused, "nn-directional+fused", Directional, true),
        Row::near_neighbor(M::NnOptimalFused, "nn-optimal+fused", Optimal, true),
        Row::near_neighbor(M::NnConeFused, "nn-cone+fused", Cone, true),
        Row { on_device: false, ..Row::new(M::Cpu, "cpu") },
    ]
};

impl MethodName {
    /// Every method.
    pub const ALL: [Self; ROWS.len()] = {
        let mut all = [Self::Rc; ROWS.len()];
        let mut i = 0;
        while i < all.len() {
            all[i] = ROWS[i].method;
            // A row stands at the place of its method.
            assert!(all[i] as usize == i);
            i += 1;
        }
        all
    };

    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// As on the command line, in files and in reports.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Whether rays end before they leave the volume, once their opacity is above T. Methods that end rays have one picture,
    /// those that end none have another.
    pub fn ends_rays(self) -> bool {
        self.row().ends_rays
    }

    /// The method with the same picture that skips nothing.
    pub fn without_skipping(self) -> Self {
        if self.ends_rays() { Self::RcErt } else { Self::Rc }
    }

    /// Whether it runs on a device; else in f64 on the CPU.
    pub fn on_device(self) -> bool {
        self.row().on_device
    }

    /// Whether the law of skipping holds for it to the last bit: it is that of pictures of one device whose rays end.
    pub fn under_the_law(self) -> bool {
        self.ends_rays() && self.on_device()
    }

    /// Whether empty blocks of cells are skipped [KW03 §2.3].
    pub fn skips_blocks(self) -> bool {
        self.row().blocks
    }

    /// The distances a method of near-neighbor skipping reads; none for the others.
    pub fn distance(self) -> Option<Distance> {
        self.row().distance
    }

    /// Whether anything is known of what lies ahead: blocks or distances.
    pub fn looks_ahead(self) -> bool {
        self.skips_blocks() || self.distance().is_some()
    }

    /// Whether main passes decide where the ray goes on, so that intermediate passes after the first are not needed.
    pub fn fused(self) -> bool {
        self.row().fused
    }
}

/// How fragments are kept from running.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Cull {
    /// What works on the device, checked there.
    #[default]
    Auto,
    /// The device's depth bounds test.
    Bounds,
    /// An early, read-only depth test against the box drawn at the depth of the bound.
    Ztest,
    /// The shader looks and discards.
    Discard,
}

/// The depth buffer's format: how finely marks are told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum DepthFormat {
    /// D32_SFLOAT, which every device has.
    #[default]
    D32,
    /// X8_D24_UNORM.
    D24,
    /// D16_UNORM, which every device has.
    D16,
}

impl DepthFormat {
    pub fn name(self) -> &'static str {
        match self {
            Self::D32 => "d32",
            Self::D24 => "d24",
            Self::D16 => "d16",
        }
    }

    /// Bits of its codes; 0 for a float.
    pub fn bits(self) -> u32 {
        match self {
            Self::D32 => 0,
            Self::D24 => 24,
            Self::D16 => 16,
        }
    }

    /// The largest difference between depths of sections that it may not tell apart.
    pub fn resolution(self) -> f64 {
        match self {
            // Half a unit in the last place below 0.5.
            Self::D32 => 0.5f64.powi(26),
            _ => 1.0 / f64::from((1u32 << self.bits()) - 1),
        }
    }
}

/// How the intermediate pass stores its decision.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "kebab-case")]
pub enum Mark {
    /// What works on the device, checked there.
    #[default]
    Auto,
    /// `gl_FragDepth` with conservative depth.
    Fragdepth,
    /// `gl_FragDepth` as the thesis had it.
    FragdepthAny,
    /// A colour attachment, copied into the depth buffer.
    Copy,
}
