//! Errors of adaptive steps by their tolerance (Weiler03 "Adaptive Sampling").

use super::way::Way;
use super::{AccuracyJob, Curve};
use crate::error::{Error, Result};
use crate::method;
use crate::scene::Scene;
use crate::scene::settings::{Classification, Filter, MethodName, Offset};

/// What curves of tolerances are called.
const ADAPTIVE: &str = "adaptive";

/// The scene in adaptive steps of a tolerance.
pub fn with_tolerance(scene: &Scene, filter: Filter, tolerance: f64) -> Scene {
    let mut scene = scene.clone();
    let settings = &mut scene.settings;
    (settings.adaptive.importance, settings.adaptive.tolerance) = (true, tolerance);
    let sampling = &mut settings.sampling;
    (sampling.classification, sampling.offset, sampling.filter) = (Classification::Post, Offset::Left, filter);
    scene
}

impl AccuracyJob {
    /// The methods that take adaptive steps, where tolerances are asked for.
    pub(super) fn adaptive_methods(&self, scene: &Scene) -> Vec<MethodName> {
        let Some(tolerance) = self.tolerances.first() else { return Vec::new() };
        let adaptive = with_tolerance(scene, self.settings.sampling.filter, *tolerance);
        self.methods.iter().copied().filter(|name| method::takes(*name, &adaptive)).collect()
    }

    /// Whether adaptive steps can be measured, where they are asked for.
    ///
    /// # Errors
    /// When they cannot, or no method takes them.
    pub(super) fn check_adaptive(&self, scene: &Scene) -> Result<()> {
        let refused = |problem: &str, remedy: &str| Err(Error::usage("--tolerances", problem, remedy));
        if self.settings.adaptive.importance {
            let remedy = "leave --importance out; --tolerances has the errors";
            return refused(
                "ask for adaptive steps beside steps that are all alike, and the scene has no others",
                remedy,
            );
        }
        if !self.tolerances.is_empty() && self.adaptive_methods(scene).is_empty() {
            let remedy = "name rc-ert, single-pass or single-pass+compute, and show colours of voxels alone";
            return refused("ask for adaptive steps, and none of the methods takes them of this scene", remedy);
        }
        for tolerance in &self.tolerances {
            with_tolerance(scene, self.settings.sampling.filter, *tolerance).settings.check()?;
        }
        Ok(())
    }

    /// Who interpolates, with the words for it: as the scene has it, and the shader.
    pub(super) fn adaptive_ways(&self) -> Vec<(Filter, String)> {
        let own = self.settings.sampling.filter;
        let exact = format!("{ADAPTIVE}, {}", Way { filter: Filter::Exact, ..Way::of(&self.settings) }.filtered());
        let others = (own != Filter::Exact).then_some((Filter::Exact, exact));
        [(own, ADAPTIVE.to_owned())].into_iter().chain(others).collect()
    }

    /// The tolerances, each once, falling.
    pub(super) fn falling_tolerances(&self) -> Vec<f64> {
        let mut tolerances = self.tolerances.clone();
        tolerances.sort_by(|a, b| b.total_cmp(a));
        tolerances.dedup();
        tolerances
    }
}

impl Curve {
    /// Whether it goes by the tolerance of adaptive steps.
    pub fn is_of_tolerances(&self) -> bool {
        self.points.iter().any(|point| point.tolerance.is_some())
    }

    /// With which tolerances the largest error is no larger.
    pub(super) fn kept_tolerances(&self) -> String {
        let (kept, broken): (Vec<_>, Vec<_>) = self
            .points
            .iter()
            .filter_map(|point| Some((point.tolerance?, point.max?)))
            .partition(|(tolerance, max)| max <= tolerance);
        let list = |those: &[(f64, f64)]| those.iter().map(|(t, _)| format!("{t:.2e}")).collect::<Vec<_>>().join(", ");
        match (kept.is_empty(), broken.is_empty()) {
            (_, true) => "the largest error is within every tolerance".to_owned(),
            (true, false) => "the largest error is within none of the tolerances".to_owned(),
            (false, false) => {
                format!("the largest error is within the tolerances {}; not within {}", list(&kept), list(&broken))
            }
        }
    }
}
