//! What has to be there before a frame: walking the frame's reads backwards, the steps that upload or build what is read
//! are put in front, each once.

use std::ops::Range;

use crate::part::resource::{Facts, Life, Origin, Resource};
use crate::part::{Group, Step};
use crate::pass::build::{self, recipe};
use crate::resource;
use crate::scene::settings::Distance;
use crate::scene::settings::ShellMode;
use crate::scene::shells::Shells;
use crate::structure::Lookup;

/// A resource and what it was made for: frames with equal assets share it.
#[derive(Clone, Copy, Debug)]
pub struct Asset {
    pub resource: Resource,
    /// What of the look-ups it depends on; none for what serves all of them.
    pub lookup: Option<Lookup>,
    /// The level of the shell it was made for, in the volume's own unit; none for what was made for none.
    pub level: Option<f64>,
}

impl PartialEq for Asset {
    fn eq(&self, other: &Self) -> bool {
        let same = match self.level {
            // Shells have other numbers where there are more of them, or fewer.
            Some(_) => std::ptr::eq(self.resource.of, other.resource.of),
            None => self.resource == other.resource,
        };
        same && self.level == other.level && self.lookup == other.lookup
    }
}

impl Asset {
    /// The asset that a step means by a resource, where distances are made for `lookup`, and shells are these.
    pub fn of(resource: Resource, lookup: Option<Lookup>, shells: Option<&Shells>) -> Self {
        let serves_all = Self { resource, lookup: None, level: None };
        let cells = lookup.map(|lookup| Lookup { distance: Distance::Omni, view: None, ..lookup });
        match (resource.of.life, &resource.of.origin) {
            // It is the texture that `nn-omni` looks up.
            _ if resource == resource::OMNI_DISTANCE => {
                Self { resource: resource::NEAREST_DISTANCE, lookup: cells, ..serves_all }
            }
            (Life::View, _) => Self { lookup, ..serves_all },
            (Life::Transfer, Origin::Built) => Self { lookup: cells, ..serves_all },
            // The outermost shell as a surface.
            _ if resource == resource::SURFACE_LEVELS => {
                let outermost = shells.filter(|shells| shells.mode == ShellMode::Surface);
                Self { level: outermost.and_then(|shells| shells.outermost()), ..serves_all }
            }
            (Life::Shell, _) => {
                let shell = shells.and_then(|shells| shells.list.get(usize::from(resource.index)));
                Self { level: shell.map(|shell| shell.level), ..serves_all }
            }
            _ => serves_all,
        }
    }
}

/// Who makes an asset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Maker {
    /// The host has it, and it is uploaded.
    Upload,
    /// The host builds it, and it is uploaded.
    Host,
    /// Compute shaders.
    Compute,
}

/// An asset and the steps of the plan that make it.
#[derive(Clone, Debug, PartialEq)]
pub struct Build {
    pub asset: Asset,
    pub maker: Maker,
    pub steps: Range<usize>,
}

impl Build {
    /// Whether it is made anew for every frame.
    pub fn of_frame(&self) -> bool {
        self.asset.resource.of.life == Life::Frame
    }
}

/// Uploads and builds in the order in which they run.
#[derive(Clone, Debug, Default)]
pub struct Builds {
    pub steps: Vec<Step>,
    pub list: Vec<Build>,
}

impl Builds {
    /// What steps that read `read` need first; what is made anew for every frame comes last. `on_host`: the host builds
    /// what it has a form for.
    pub fn of(facts: &Facts, on_host: bool, read: &[Resource]) -> Self {
        let mut builds = Self::default();
        let of_frame = |resource: &&Resource| resource.of.life == Life::Frame;
        let before = read.iter().filter(|resource| !of_frame(resource));
        before.chain(read.iter().filter(of_frame)).for_each(|resource| builds.need(facts, on_host, *resource));
        builds
    }

    /// Everything that the distances of `facts` are made from, and they themselves.
    pub fn of_distances(facts: &Facts, on_host: bool) -> Self {
        Self::of(facts, on_host, &[resource::NEAREST_DISTANCE])
    }

    fn need(&mut self, facts: &Facts, on_host: bool, resource: Resource) {
        let asset = Asset::of(resource, facts.lookup, facts.scene.shells.as_deref());
        if self.list.iter().any(|build| build.asset == asset) {
            return;
        }
        let (maker, steps) = match (&resource.of.origin, recipe(resource)) {
            (Origin::Drawn | Origin::Passing, _) | (Origin::Built, None) => return,
            (Origin::Host(_), _) => (Maker::Upload, vec![build::host(resource, Group::Upload)]),
            (Origin::Built, Some(recipe)) => match recipe.steps.filter(|_| !on_host || recipe.host.is_none()) {
                None => (Maker::Host, vec![build::host(resource, Group::Structure)]),
                Some(steps) => {
                    let steps = steps(facts, resource.index);
                    reads(&steps).into_iter().for_each(|read| self.need(facts, on_host, read));
                    (Maker::Compute, steps)
                }
            },
        };
        let first = self.steps.len();
        self.steps.extend(steps);
        self.list.push(Build { asset, maker, steps: first..self.steps.len() });
    }
}

/// What steps read, each resource once, in order.
pub fn reads(steps: &[Step]) -> Vec<Resource> {
    let mut found = Vec::new();
    for access in steps.iter().flat_map(|step| step.accesses.iter()).filter(|access| access.usage.reads()) {
        if !found.contains(&access.resource) {
            found.push(access.resource);
        }
    }
    found
}
