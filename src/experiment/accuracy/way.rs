//! Ways of sampling a scene.

use crate::scene::Settings;
use crate::scene::settings::{
    Accumulate, Alpha, Classification, Filter, GradientOperator, GradientTexture, Gradients, Last, Offset, Refine,
    VolumeTexture,
};

/// How samples are taken and kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    pub classification: Classification,
    pub offset: Offset,
    pub last: Last,
    pub alpha: Alpha,
    pub accumulate: Accumulate,
    pub texture: VolumeTexture,
    pub filter: Filter,
    /// How the places of iso-surfaces are found.
    pub refine: Refine,
    /// Where the gradients of what is lit come from.
    pub gradient: Gradient,
}

/// Where gradients come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gradient {
    /// Differences in the shader.
    OnTheFly,
    /// A texture of them.
    Precomputed(GradientOperator, GradientTexture),
}

impl Gradient {
    const ALL: [Self; 7] = [
        Self::OnTheFly,
        Self::Precomputed(GradientOperator::Central, GradientTexture::Rgba8),
        Self::Precomputed(GradientOperator::Central, GradientTexture::Rgba16f),
        Self::Precomputed(GradientOperator::Central, GradientTexture::Rgba32f),
        Self::Precomputed(GradientOperator::Sobel, GradientTexture::Rgba8),
        Self::Precomputed(GradientOperator::Sobel, GradientTexture::Rgba16f),
        Self::Precomputed(GradientOperator::Sobel, GradientTexture::Rgba32f),
    ];

    fn of(settings: &Settings) -> Self {
        let shading = &settings.shading;
        match shading.gradients {
            Gradients::OnTheFly => Self::OnTheFly,
            Gradients::Precomputed => Self::Precomputed(shading.gradient, shading.format),
        }
    }

    fn apply(self, settings: &mut Settings) {
        let shading = &mut settings.shading;
        match self {
            Self::OnTheFly => (shading.gradients, shading.gradient) = (Gradients::OnTheFly, GradientOperator::Central),
            Self::Precomputed(operator, texture) => {
                shading.gradients = Gradients::Precomputed;
                (shading.gradient, shading.format) = (operator, texture);
            }
        }
    }

    /// `gradients on the fly`, `sobel rgba8`.
    pub fn words(self) -> String {
        match self {
            Self::OnTheFly => "gradients on the fly".to_owned(),
            Self::Precomputed(operator, texture) => format!("{operator:?} {}", texture.name()).to_lowercase(),
        }
    }
}

impl Way {
    pub fn of(settings: &Settings) -> Self {
        let sampling = &settings.sampling;
        Self {
            classification: sampling.classification,
            offset: sampling.offset,
            last: sampling.last,
            alpha: sampling.alpha,
            accumulate: settings.image.accumulate,
            texture: settings.volume.texture,
            filter: sampling.filter,
            refine: settings.surface.refine,
            gradient: Gradient::of(settings),
        }
    }

    pub fn apply(self, settings: &mut Settings) {
        let sampling = &mut settings.sampling;
        (sampling.offset, sampling.last, sampling.alpha) = (self.offset, self.last, self.alpha);
        (settings.image.accumulate, settings.volume.texture) = (self.accumulate, self.texture);
        (settings.sampling.filter, settings.sampling.classification) = (self.filter, self.classification);
        settings.surface.refine = self.refine;
        self.gradient.apply(settings);
    }

    /// `not refined`, `refined linear`.
    pub fn refined(self) -> String {
        match self.refine {
            Refine::None => "not refined".to_owned(),
            refine => format!("refined {refine:?}").to_lowercase(),
        }
    }

    /// `exact filter`.
    pub fn filtered(self) -> String {
        format!("{:?} filter", self.filter).to_lowercase()
    }

    /// What differs from the scene's own, in words.
    pub fn words(self, own: Self) -> String {
        let mut words = Vec::new();
        let mut say = |differs: bool, word: String| words.extend(differs.then_some(word));
        let classified = match self.classification {
            Classification::Post => "post-classified",
            Classification::PreIntegrated => "pre-integrated",
        };
        say(self.classification != own.classification, classified.to_owned());
        say(self.offset != own.offset, format!("{:?}", self.offset).to_lowercase());
        say(self.last != own.last, format!("{:?}", self.last).to_lowercase());
        say(self.filter != own.filter, self.filtered());
        say(self.refine != own.refine, self.refined());
        say(self.gradient != own.gradient, self.gradient.words());
        say(self.alpha != own.alpha, format!("{:?} alpha", self.alpha).to_lowercase());
        say(self.accumulate != own.accumulate, format!("{:?}", self.accumulate).to_lowercase());
        say(self.texture != own.texture, format!("{:?} texture", self.texture).to_lowercase());
        words.join(", ")
    }

    /// The scene's own way and the two of the second order, and one change of each other kind.
    pub fn some(own: Self) -> Vec<Self> {
        let post = Self { classification: Classification::Post, ..own };
        let second = Self { offset: Offset::Midpoint, last: Last::Partial, ..post };
        let left = Self { offset: Offset::Left, ..second };
        let between = Self { classification: Classification::PreIntegrated, ..left };
        let exact = |way: Self| Self { filter: Filter::Exact, ..way };
        let mut ways = vec![
            own,
            second,
            between,
            exact(left),
            exact(second),
            exact(between),
            Self { alpha: Alpha::Paper, ..own },
            Self { accumulate: Accumulate::Rgba16f, ..exact(second) },
            Self { accumulate: Accumulate::Rgba8, ..exact(second) },
            Self { texture: VolumeTexture::R16, ..second },
            Self { texture: VolumeTexture::R32f, ..second },
        ];
        let mut seen = Vec::new();
        ways.retain(|way| {
            !seen.contains(way) && {
                seen.push(*way);
                true
            }
        });
        ways
    }

    /// The ways to find the places of iso-surfaces, the scene's own first, and each interpolated in the shader; and the ways to take
    /// gradients, at places that are as near to the surface as the filter has them.
    pub fn of_surfaces(own: Self) -> Vec<Self> {
        let refined =
            |filter: Filter| [Refine::None, Refine::Linear, Refine::Exact].map(|refine| Self { refine, filter, ..own });
        // Between nearest voxels there is nothing to refine.
        let refine = if own.filter == Filter::Nearest { own.refine } else { Refine::Exact };
        let lit = Gradient::ALL.map(|gradient| Self { gradient, refine, ..own });
        // The exact surface between nearest voxels is another one than that of the interpolant.
        let exact = refined(Filter::Exact).into_iter().filter(|_| own.filter != Filter::Nearest);
        let others = refined(own.filter).into_iter().chain(exact).chain(lit);
        let mut ways = vec![own];
        for way in others {
            if !ways.contains(&way) {
                ways.push(way);
            }
        }
        ways
    }

    /// Every way, the scene's own first.
    pub fn all(own: Self) -> Vec<Self> {
        let (post, between) = (Classification::Post, Classification::PreIntegrated);
        let mut ways = vec![own];
        for (classification, offset) in [(post, Offset::Left), (post, Offset::Midpoint), (between, Offset::Left)] {
            for last in [Last::Full, Last::Partial] {
                for alpha in [Alpha::Exponential, Alpha::Paper] {
                    for accumulate in [Accumulate::Rgba32f, Accumulate::Rgba16f, Accumulate::Rgba8] {
                        for texture in [VolumeTexture::Native, VolumeTexture::R16, VolumeTexture::R32f] {
                            for filter in [Filter::Hardware, Filter::Exact] {
                                let way =
                                    Self { classification, offset, last, alpha, accumulate, texture, filter, ..own };
                                ways.extend((way != own).then_some(way));
                            }
                        }
                    }
                }
            }
        }
        ways
    }
}

/// The step in voxels, and M so that a pass goes as far as with the scene's own step of one voxel.
pub fn with_step(settings: &mut Settings, own: &Settings, step: f64) {
    settings.sampling.step = step;
    let samples = f64::from(own.sampling.samples_per_pass) / step;
    // The cast saturates, and the check of the settings refuses what is too much.
    settings.sampling.samples_per_pass = samples.round().max(1.0) as u32;
}
