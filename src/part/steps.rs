//! The steps of a frame while they are lined up.

use std::collections::HashSet;
use std::hash::Hash;
use std::sync::Arc;

use super::access::Access;
use super::{Constant, Step, Work};
use crate::glsl::Shader;

/// Steps in order. Those of thousands of passes hardly differ, so they hold one list of accesses, one of constants and one
/// shader together.
#[derive(Default)]
pub struct Steps {
    list: Vec<Step>,
    /// The part of each ray that steps are about.
    section: u32,
    /// The counting step that steps hang on.
    guard: Option<u32>,
    /// Counting steps so far.
    counted: u32,
    accesses: HashSet<Arc<Vec<Access>>>,
    constants: HashSet<Arc<Vec<Constant>>>,
    shaders: HashSet<Arc<Shader>>,
}

impl Steps {
    /// Makes room for so many more: growing would take twice the memory for a moment.
    pub fn reserve(&mut self, count: usize) {
        self.list.reserve_exact(count);
    }

    /// The steps in order.
    pub fn into_list(self) -> Vec<Step> {
        self.list
    }

    /// Steps that follow are about the part of each ray behind so many layers, and hang on a counting step.
    pub fn enter(&mut self, section: u32, guard: Option<u32>) {
        (self.section, self.guard) = (section, guard);
    }

    /// Adds a step. Those that follow a counting one hang on it.
    pub fn push(&mut self, mut step: Step) {
        (step.section, step.guard) = (self.section, self.guard);
        if step.section > 0 {
            step.name = format!("{} behind layer {}", step.name, step.section - 1);
        }
        if step.group.counts() {
            self.guard = Some(self.counted);
            self.counted += 1;
        }
        share(&mut self.accesses, &mut step.accesses);
        match &mut step.work {
            Work::Draw(draw) => {
                share(&mut self.constants, &mut draw.constants);
                draw.shader.iter_mut().for_each(|shader| share(&mut self.shaders, shader));
            }
            Work::Pixels(pixels) => {
                share(&mut self.constants, &mut pixels.constants);
                share(&mut self.shaders, &mut pixels.shader);
            }
            _ => {}
        }
        self.list.push(step);
    }

    /// Adds steps.
    pub fn extend(&mut self, steps: impl IntoIterator<Item = Step>) {
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
