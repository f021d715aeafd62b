//! Curves that do not go by the step: shells by their number, adaptive steps by their tolerance, ways through cells by their tables.

use super::adaptive::with_tolerance;
use super::cells;
use super::run::{Asked, curve, point};
use super::shells;
use super::{AccuracyJob, Curve, Point, fit};
use crate::error::Result;
use crate::measure::record::Clock;
use crate::measure::runner::{Effort, Runner};
use crate::scene::Scene;
use crate::scene::settings::MethodName;

impl AccuracyJob {
    /// Draws a scene by the method of a curve, whose point it is with this step and M, before `told` says what it goes by.
    fn add(
        &self,
        asked: &Asked,
        curve: &mut Curve,
        (scene, step, samples): (Scene, f64, u32),
        told: impl Fn(&mut Point),
    ) -> Result<()> {
        let info = &asked.checked.device.info;
        let clock = Clock::on(info.is_cpu(), info.timestamp_valid_bits > 0);
        let effort = Effort { warmups: usize::from(self.repeats > 0), repeats: self.repeats, reference: false };
        let mut runner = Runner::new(Some(asked.checked), scene, String::new());
        for one in runner.measure(std::slice::from_ref(&curve.settings.method), effort, &|_| {})? {
            let mut point = point(step, samples, &one, asked.truth, clock)?;
            told(&mut point);
            curve.points.push(point);
        }
        Ok(())
    }

    /// Shells by their number.
    pub(super) fn shell_curve(&self, asked: &Asked, name: MethodName) -> Result<Curve> {
        let mut curve = Curve {
            expected: Some(shells::EXPECTED_ORDER),
            remarks: vec![shells::REMARK.to_owned()],
            ..curve(asked, asked.own, asked.scene, name)
        };
        for count in self.shell_numbers() {
            let scene = shells::with_shells(asked.scene, count)?;
            self.add(asked, &mut curve, (scene, 1.0 / f64::from(count), 0), |point| point.shells = Some(count))?;
        }
        Ok(fitted(curve))
    }

    /// Adaptive steps by their tolerance.
    pub(super) fn adaptive_curves(&self, asked: &Asked, name: MethodName) -> Result<Vec<Curve>> {
        let mut curves = Vec::new();
        for (filter, variation) in self.adaptive_ways() {
            let adaptive = with_tolerance(asked.scene, filter, asked.scene.settings.adaptive.tolerance);
            let mut curve = Curve { variation, expected: None, ..curve(asked, asked.own, &adaptive, name) };
            for tolerance in self.falling_tolerances() {
                let scene = with_tolerance(asked.scene, filter, tolerance);
                let (step, samples) = (scene.settings.step(), scene.settings.sampling.samples_per_pass);
                let told = |point: &mut Point| point.tolerance = Some(tolerance);
                self.add(asked, &mut curve, (scene, step, samples), told)?;
            }
            curves.push(curve);
        }
        Ok(curves)
    }

    /// The exact integral of each way through a cell, and tables of ever more nodes where there are colours.
    pub(super) fn cell_curves(&self, asked: &Asked, name: MethodName) -> Result<Vec<Curve>> {
        let mut curves = Vec::new();
        for (variation, expected, sizes) in cells::ways(asked.scene, &self.table_sizes) {
            let own = curve(asked, asked.own, asked.scene, name);
            let mut curve = Curve { variation, expected, remarks: Vec::new(), ..own };
            for nodes in sizes {
                let scene = cells::with_table(asked.scene, nodes)?;
                let step = nodes.map_or(scene.settings.sampling.step, |nodes| 1.0 / f64::from(nodes - 1));
                self.add(asked, &mut curve, (scene, step, 1), |point| point.table = nodes)?;
            }
            curves.push(fitted(curve));
        }
        Ok(curves)
    }
}

/// The curve with its order.
fn fitted(mut curve: Curve) -> Curve {
    let errors: Vec<(f64, f64)> = curve.points.iter().filter_map(|p| Some((p.step, p.rmse?))).collect();
    curve.order = fit(&errors);
    curve
}
