//! The one table of methods: which passes, in which order.

use std::collections::HashSet;
use std::hash::Hash;
use std::sync::Arc;

use crate::glsl::Shader;
use crate::pass::cull::{Form, Mark};
use crate::pass::resource::{Access, Resource};
use crate::pass::{
    Constant, Needs, Step, Work, alive, block_skip, build, clear, direction, entry, fused, main_pass, mark_copy,
    near_neighbor, termination,
};
use crate::scene::Scene;
use crate::scene::settings::{Cull, MethodName};
use crate::structure::Lookup;
use crate::structure::blocks::BLOCK;
use crate::structure::grid::Grid;

/// Every so many main passes the rays that are left are counted.
pub const BATCH: u32 = 8;

/// The bound of main passes that are switched on and off only: rays that go on hold 0, others 0.5 or 1.
const SWITCH: f32 = 0.25;

/// Steps before the first main pass, those of most structures counted.
const STEPS_BEFORE: usize = 32;

/// Steps in order. Those of thousands of passes hardly differ, so they hold one list of accesses, one of constants and one
/// shader together.
#[derive(Default)]
struct Steps {
    list: Vec<Step>,
    accesses: HashSet<Arc<Vec<Access>>>,
    constants: HashSet<Arc<Vec<Constant>>>,
    shaders: HashSet<Arc<Shader>>,
}

impl Steps {
    /// With room for a frame of so many passes: growing would take twice the memory for a moment.
    fn with_room(passes: u32, method: MethodName, form: Option<Form>) -> Self {
        let decides = form.is_some() && !method.fused();
        let copies = form.is_some_and(|form| form.mark == Mark::Copy);
        let a_pass = 1 + usize::from(decides) + usize::from(copies);
        let room = a_pass * passes as usize + (passes / BATCH) as usize;
        Self { list: Vec::with_capacity(room + STEPS_BEFORE), ..Self::default() }
    }

    fn push(&mut self, mut step: Step) {
        share(&mut self.accesses, &mut step.accesses);
        if let Work::Draw(draw) = &mut step.work {
            share(&mut self.constants, &mut draw.constants);
            if let Some(shader) = &mut draw.shader {
                share(&mut self.shaders, shader);
            }
        }
        self.list.push(step);
    }

    fn extend(&mut self, steps: impl IntoIterator<Item = Step>) {
        steps.into_iter().for_each(|step| self.push(step));
    }
}

/// Takes what was seen before in place of its equal.
fn share<T: Hash + Eq>(seen: &mut HashSet<Arc<T>>, of_step: &mut Arc<T>) {
    match seen.get(of_step) {
        Some(before) => *of_step = before.clone(),
        None => {
            seen.insert(of_step.clone());
        }
    }
}

/// Steps of a frame, in order.
pub fn steps(scene: &Scene, needs: Needs, passes: u32, form: Option<Form>) -> Vec<Step> {
    let method = &scene.settings.method;
    let mut steps = Steps::with_room(passes, method.name, form);
    if method.name.skips_blocks() && needs.skips {
        steps.push(build::cell_range(&Grid::new(&scene.field, BLOCK as u32)));
    }
    if let Some(lookup) = Lookup::of(scene).filter(|_| needs.skips) {
        steps.extend(build::steps(&scene.field, &lookup));
    }
    steps.push(entry::entry());
    steps.push(direction::direction());
    // Where no ray ends early and nothing can be skipped there is nothing to decide.
    let decides = needs.ends || needs.skips;
    match (method.name, form.filter(|_| decides)) {
        (MethodName::RcErt | MethodName::Cpu, Some(form)) if needs.ends => {
            switched(&mut steps, scene, needs, (passes, form, 1), &|pass| termination::termination(scene, pass, form));
        }
        (MethodName::RcBlock, Some(form)) if needs.skips => {
            let first = u32::from(!method.block_first);
            switched(&mut steps, scene, needs, (passes, form, first), &|pass| {
                block_skip::block_skip(scene, needs, pass, form)
            });
        }
        (MethodName::RcBlock, Some(form)) => {
            switched(&mut steps, scene, needs, (passes, form, 1), &|pass| termination::termination(scene, pass, form));
        }
        (name, Some(form)) if name.fused() => {
            steps.extend(needs.ends.then(clear::clear));
            steps.push(near_neighbor::near_neighbor(scene, needs, 0, passes, form));
            for pass in 0..passes {
                decided(&mut steps, pass, form, (form.mark == Mark::Copy).then_some(Resource::Marks));
                steps.push(fused::fused(scene, needs, pass, passes, form));
            }
        }
        (name, Some(form)) if name.distance().is_some() => {
            steps.extend(needs.ends.then(clear::clear));
            for pass in 0..passes {
                steps.push(near_neighbor::near_neighbor(scene, needs, pass, passes, form));
                decided(&mut steps, pass, form, None);
                let end = crate::reference::section::section_end(pass, passes) as f32;
                steps.push(main_pass::main_pass(scene, needs, pass, Some((form.cull, end))));
            }
        }
        _ => steps.extend((0..passes).map(|pass| main_pass::main_pass(scene, needs, pass, None))),
    }
    steps.list
}

/// Main passes switched by an intermediate pass before each, from main pass `first` on [KW03 §2.1].
fn switched(
    steps: &mut Steps,
    scene: &Scene,
    needs: Needs,
    (passes, form, first): (u32, Form, u32),
    decide: &dyn Fn(u32) -> Step,
) {
    if first == 0 && needs.ends {
        steps.push(clear::clear());
    }
    for pass in 0..passes {
        let mut culled: Option<(Cull, f32)> = None;
        if pass >= first {
            steps.push(decide(pass));
            decided(steps, pass, form, None);
            culled = Some((form.cull, SWITCH));
        }
        steps.push(main_pass::main_pass(scene, needs, pass, culled));
    }
}

/// What follows a step that has decided about main pass `pass`: the copy, where marks go that way, and now and then the
/// count of rays left, with a target `beside` it.
fn decided(steps: &mut Steps, pass: u32, form: Form, beside: Option<Resource>) {
    if form.mark == Mark::Copy {
        steps.push(mark_copy::mark_copy(pass));
    }
    if pass > 0 && pass.is_multiple_of(BATCH) {
        steps.push(alive::alive(pass, beside));
    }
}
