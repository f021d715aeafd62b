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

    /// Adds a step.
    pub fn push(&mut self, mut step: Step) {
        share(&mut self.accesses, &mut step.accesses);
        if let Work::Draw(draw) = &mut step.work {
            share(&mut self.constants, &mut draw.constants);
            if let Some(shader) = &mut draw.shader {
                share(&mut self.shaders, shader);
            }
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
