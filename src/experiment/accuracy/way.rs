//! Ways of sampling a scene.

use crate::scene::Settings;
use crate::scene::settings::{Accumulate, Alpha, Classification, Filter, Last, Offset, Refine, VolumeTexture};

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
        }
    }

    pub fn apply(self, settings: &mut Settings) {
        let sampling = &mut settings.sampling;
        (sampling.offset, sampling.last, sampling.alpha) = (self.offset, self.last, self.alpha);
        (settings.image.accumulate, settings.volume.texture) = (self.accumulate, self.texture);
        (settings.sampling.filter, settings.sampling.classification) = (self.filter, self.classification);
        settings.surface.refine = self.refine;
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
        say(self.filter != own.filter, format!("{:?} filter", self.filter).to_lowercase());
        say(
            self.refine != own.refine,
            format!("refined {:?}", self.refine).to_lowercase().replace("refined none", "not refined"),
        );
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

    /// The ways to find the places of iso-surfaces, the scene's own first, and each interpolated in the shader.
    pub fn of_surfaces(own: Self) -> Vec<Self> {
        let refined =
            |filter: Filter| [Refine::None, Refine::Linear, Refine::Exact].map(|refine| Self { refine, filter, ..own });
        let others = refined(own.filter).into_iter().chain(refined(Filter::Exact));
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
