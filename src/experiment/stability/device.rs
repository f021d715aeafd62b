//! A device as an integrator; pipelines are kept from case to case.

use super::judge::{Integrator, Rendered};
use crate::error::Result;
use crate::frame::compile::target_format;
use crate::frame::{GpuFrame, Measure, Resident, Structures, cpu};
use crate::measure::limits;
use crate::measure::runner::{Checked, builds_on_host, refuse_missing};
use crate::method;
use crate::part::resource::Resource;
use crate::plan::{self, Plan};
use crate::scene::Scene;
use crate::vulkan::vk;

pub struct OnDevice<'a> {
    checked: &'a Checked,
    resident: Resident,
    structures: Structures,
}

impl<'a> OnDevice<'a> {
    pub fn new(checked: &'a Checked) -> Self {
        Self { checked, resident: Resident::new(&checked.device), structures: Structures::default() }
    }

    fn on_cpu(&self, scene: &Scene) -> Result<Rendered> {
        let plan = plan::plan(scene, method::papers_form(method::CPU.name()))?;
        let structures = Structures { table: self.structures.table(scene), ..Structures::default() };
        let frame = cpu::run(scene, &plan, &structures, self.sub_pixel_bits());
        Ok(Rendered { pixels: frame.pixels, steps: plan.steps.len() })
    }

    fn frame(&mut self, scene: &Scene, plan: &Plan) -> Result<Rendered> {
        let device = &self.checked.device;
        limits::check_device(&device.info, scene, plan)?;
        self.structures.table = self.structures.table(scene);
        if builds_on_host(device, scene, plan) {
            self.structures.prepare(scene, plan);
        }
        self.resident.prepare(scene, plan, &self.structures)?;
        let mut frame = GpuFrame::new(device, scene, plan, &mut self.resident, self.checked.early_end)?;
        frame.run(Measure::Nothing)?;
        let pixels = frame.picture()?.into_iter().map(|pixel| pixel.map(f64::from)).collect();
        Ok(Rendered { pixels, steps: plan.steps.len() })
    }
}

impl Integrator for OnDevice<'_> {
    fn begin(&mut self) {
        self.resident.forget_scene();
        self.structures = Structures::default();
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
        let depth = target_format(Resource::Stored, scene.settings.formats());
        let attached = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
        if form.is_some() && !self.checked.device.format_supports(depth, attached) {
            return Ok(Err(format!("no depth format {depth:?}")));
        }
        let plan = plan::plan(scene, form)?;
        self.frame(scene, &plan).map(Ok)
    }
}
