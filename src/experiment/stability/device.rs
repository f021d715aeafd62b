//! A device as an integrator; pipelines are kept from case to case.

use super::judge::{Integrator, Rendered};
use crate::error::Result;
use crate::frame::{GpuFrame, Measure, Resident, Structures, cpu, plan_on};
use crate::measure::limits;
use crate::measure::{Checked, refuse_missing};
use crate::method;
use crate::plan::{self, Plan};
use crate::resource;
use crate::scene::Scene;
use crate::vulkan::vk;

pub struct OnDevice<'a> {
    checked: &'a Checked,
    resident: Resident,
}

impl<'a> OnDevice<'a> {
    pub fn new(checked: &'a Checked) -> Self {
        Self { checked, resident: Resident::new(&checked.device) }
    }

    fn on_cpu(&mut self, scene: &Scene) -> Result<Rendered> {
        let plan = plan::plan(scene, method::papers_form(method::CPU.name()))?;
        let structures = Structures { table: self.resident.table(scene), ..Structures::default() };
        let frame = cpu::run(scene, &plan, &structures, self.sub_pixel_bits());
        Ok(Rendered { pixels: frame.pixels, steps: plan.steps.len() })
    }

    fn frame(&mut self, scene: &Scene, plan: &Plan) -> Result<Rendered> {
        let device = &self.checked.device;
        limits::check_device(&device.info, scene, plan)?;
        self.resident.prepare(scene, plan)?;
        let mut frame = GpuFrame::new(device, scene, plan, &mut self.resident, self.checked.early_end)?;
        frame.run(Measure::Nothing)?;
        let pixels = frame.picture()?.into_iter().map(|pixel| pixel.map(f64::from)).collect();
        Ok(Rendered { pixels, steps: plan.steps.len() })
    }
}

impl Integrator for OnDevice<'_> {
    fn begin(&mut self) {
        self.resident.forget_scene();
    }

    fn sub_pixel_bits(&self) -> u32 {
        self.checked.device.info.sub_pixel_bits
    }

    fn render(&mut self, scene: &Scene) -> Result<std::result::Result<Rendered, String>> {
        let method = scene.settings.method.name;
        if !method::of(method)?.on_device {
            return self.on_cpu(scene).map(Ok);
        }
        let form = plan::form(scene, self.checked.check.automatic(method))?;
        if let Err(missing) = refuse_missing(self.checked, form) {
            return Ok(Err(missing.problem));
        }
        let depth = resource::STORED.format(scene.settings.formats());
        let attached = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
        if form.is_some() && !self.checked.device.format_supports(depth, attached) {
            return Ok(Err(format!("no depth format {depth:?}")));
        }
        let plan = plan_on(&self.checked.device, scene, form, None)?;
        self.frame(scene, &plan).map(Ok)
    }
}
