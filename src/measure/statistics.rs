//! The middle of a list of samples and how far they lie from it. Median and MAD, since a timer's errors are
//! one-sided: an interrupt makes a frame longer, nothing makes one shorter.

/// In the unit of the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    pub median: f64,
    pub min: f64,
    pub max: f64,
    /// Median of the absolute deviations from the median, as it is (not scaled to a standard deviation).
    pub mad: f64,
    /// How many samples.
    pub n: usize,
}

impl Statistics {
    /// `None` where there is no sample, or one is not a finite number.
    pub fn of(samples: &[f64]) -> Option<Self> {
        if samples.is_empty() || samples.iter().any(|s| !s.is_finite()) {
            return None;
        }
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        let median = middle(&sorted);
        let mut deviations: Vec<f64> = sorted.iter().map(|s| (s - median).abs()).collect();
        deviations.sort_by(f64::total_cmp);
        Some(Self { median, min: sorted[0], max: sorted[sorted.len() - 1], mad: middle(&deviations), n: sorted.len() })
    }
}

/// Of a sorted list that is not empty: the middle one, or the mean of the two middle ones.
fn middle(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[half] } else { 0.5 * sorted[half - 1] + 0.5 * sorted[half] }
}
