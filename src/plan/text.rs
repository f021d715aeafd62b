//! A plan as text, one line a step: it is read by people and held by tests.

use ash::vk;

use super::Plan;
use crate::part::access::{Access, Usage};
use crate::part::{Draw, Step, Work};
use crate::scene::texture::Within;
use crate::scene::view::View;

impl Plan {
    /// One line a step: number, name, queue, what it reads -> what it writes; then how the volume is kept, and what was
    /// left out.
    pub fn lines(&self) -> Vec<String> {
        let mut lines: Vec<String> =
            self.steps.iter().enumerate().map(|(i, step)| format!("{:>3} {}", i + 1, line(step, &self.view))).collect();
        lines.extend(self.texture.map(|texture| {
            let (name, x, pixels) = (texture.name(), Within(texture.error), Within(self.pixel_error));
            let on = if texture.measured { "" } else { " on a device that interpolates in f32 (none was asked)" };
            format!("  = volume kept as {name}: x within {x}, pixels within {pixels}{on}")
        }));
        lines.extend(self.left_out.iter().map(|l| format!("  - {} left out: {}", l.what, l.why)));
        lines
    }
}

/// The least stored depth with which fragments take part.
fn least(draw: &Draw) -> String {
    if draw.least > 0.0 { format!("{:.6}", draw.least) } else { "0".to_owned() }
}

fn line(step: &Step, view: &View) -> String {
    let names = |chosen: fn(Usage) -> bool| -> String {
        let of = |a: &&Access| chosen(a.usage) && a.usage != Usage::Vertices;
        let names: Vec<_> = step.accesses.iter().filter(of).map(|a| a.resource.label()).collect();
        names.join(", ")
    };
    let (queue, detail) = match &step.work {
        Work::Draw(draw) => {
            let mut detail = String::new();
            if draw.depths[0] != draw.depths[1] {
                detail = format!("  [depths {:.6}..{:.6}]", draw.depths[0], draw.depths[1]);
            } else if draw.test.bounds {
                detail = format!("  [bounds {}..{:.6}]", least(draw), draw.bound);
            } else if draw.test.compare == Some(vk::CompareOp::EQUAL) {
                detail = format!("  [stored = {:.6}]", draw.depths[0]);
            } else if draw.test.compare.is_some() && !draw.test.write {
                detail = format!("  [stored <= {:.6}]", draw.bound);
            } else if draw.least > 0.0 {
                detail = format!("  [discard unless {} <= stored <= {:.6}]", least(draw), draw.bound);
            } else if draw.bound < 1.0 {
                detail = format!("  [discard unless stored <= {:.6}]", draw.bound);
            }
            if let Some(parts) = (draw.geometry.parts)(view, step.pass) {
                let pixels = parts.iter().map(|part| part.pixels()).sum::<u64>();
                detail += &format!("  [{pixels} pixels, rectangles: {}]", parts.len());
            }
            ("graphics", detail)
        }
        Work::Copy { .. } | Work::Clear(_) => ("transfer", String::new()),
        Work::Dispatch(_) | Work::Pixels(_) | Work::Unpack { .. } => ("compute", String::new()),
        Work::Host(_) => ("host", String::new()),
    };
    let (reads, writes) = (names(Usage::reads), names(Usage::writes));
    let arrow = match (reads.is_empty(), writes.is_empty()) {
        (_, true) => reads,
        (true, false) => format!("-> {writes}"),
        (false, false) => format!("{reads} -> {writes}"),
    };
    format!("{:<20} {queue:<9} {arrow}{detail}", step.name)
}
