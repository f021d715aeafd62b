//! What rows are made of, methods and features, and the context that they are asked in. They stand in one file since each of
//! these types has the others in its signatures.

use std::cell::RefCell;
use std::collections::HashMap;

use super::Constant;
use super::form::Form;
use super::resource::Resource;
use super::steps::Steps;
use crate::error::{Error, Result};
use crate::math::blend::Blend;
use crate::projection::{self, Projection};
use crate::scene::Scene;
use crate::scene::settings::Distance;
use crate::scene::slices::Stack;
use crate::scene::view::View;
use crate::structure::Lookup;

/// What a method knows of what lies ahead of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ahead {
    /// Nothing.
    Nothing,
    /// Which blocks of 8^3 cells are empty [KW03 §2.3].
    Blocks,
    /// How far it is to what shows [Thesis §5.3].
    Distances(Distance),
}

/// What goes along a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Traversal {
    /// Main passes, a segment each [KW03 §2.1].
    Passes,
    /// The loop of a fragment shader that holds the whole ray [Stegmaier05 §3].
    FragmentLoop,
    /// The same loop in a compute shader.
    ComputeLoop,
    /// Slices of the volume, a sample each [Thesis §3.4].
    Slices(Stack),
    /// Nothing: nested iso-surfaces are drawn as polygons [Heidrich95 §2].
    Shells,
    /// The cells of a mesh, from each to the next (Weiler03).
    Cells(CellWalk),
}

/// What goes from cell to cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellWalk {
    /// Main passes, a cell each.
    Passes,
    /// The loop of a fragment shader.
    FragmentLoop,
    /// The same loop in a compute shader.
    ComputeLoop,
}

/// A renderer. The list of them is `crate::method::METHODS`.
pub struct Method {
    /// The name on the command line, in files and in reports.
    pub name: &'static str,
    /// What it is, in a line of the help.
    pub about: &'static str,
    /// Where it is described.
    pub source: &'static str,
    /// Whether it draws a scene.
    pub takes: fn(&Scene) -> Result<()>,
    /// Cull and mark that `auto` stands for where nothing is known of the device: those of the papers. None: it culls
    /// nothing.
    pub papers: Option<Form>,
    /// The forms it has on a device; none where it culls nothing there.
    pub forms: fn() -> Vec<Form>,
    /// Whether rays end before they leave the volume, once their opacity is above T. Methods that end rays have one picture,
    /// those that end none have another.
    pub ends_rays: bool,
    /// Whether it runs on a device; else in f64 on the CPU.
    pub on_device: bool,
    /// What it knows of what lies ahead.
    pub ahead: Ahead,
    /// Whether main passes decide where the ray goes on, so that intermediate passes after the first are not needed.
    pub fused: bool,
    /// What goes along a ray.
    pub traversal: Traversal,
    /// The method with the same samples that skips nothing, whose picture it has to the bit; none for such a method itself.
    pub skips_of: Option<&'static Method>,
    /// The steps of a frame, in order, without those that build what it reads.
    pub steps: fn(&Context, &mut Steps),
}

impl Method {
    /// The form, where it is one of the method's.
    ///
    /// # Errors
    /// When the method has no such form, with those it has.
    pub fn check(&self, form: Form) -> Result<Form> {
        let all = (self.forms)();
        if all.contains(&form) {
            return Ok(form);
        }
        let names: Vec<_> = all.into_iter().map(Form::name).collect();
        Err(Error::usage(
            format!("--cull {} --mark {}", form.cull_name(), form.mark_name()),
            format!("method {} has no such form", self.name),
            format!("choose one of {}", names.join(", ")),
        ))
    }

    /// Whether the law of skipping holds for it to the last bit: it is that of pictures of one device whose rays end.
    pub fn under_the_law(&self) -> bool {
        self.ends_rays && self.on_device
    }

    /// Whether empty blocks of cells are skipped [KW03 §2.3].
    pub fn skips_blocks(&self) -> bool {
        self.ahead == Ahead::Blocks
    }

    /// The distances a method of near-neighbor skipping reads; none for the others.
    pub fn distance(&self) -> Option<Distance> {
        match self.ahead {
            Ahead::Distances(distance) => Some(distance),
            Ahead::Nothing | Ahead::Blocks => None,
        }
    }

    /// Whether anything is known of what lies ahead: blocks or distances.
    pub fn looks_ahead(&self) -> bool {
        self.ahead != Ahead::Nothing
    }

    /// Whether main and intermediate passes are culled by the same bound, in which a ray is marked with the pass of its next work.
    pub fn marks_sections(&self) -> bool {
        self.distance().is_some() && !self.loops()
    }

    /// Whether one shader holds the whole ray, so that nothing decides between main passes and nothing is culled.
    pub fn loops(&self) -> bool {
        match self.traversal {
            Traversal::FragmentLoop | Traversal::ComputeLoop => true,
            Traversal::Cells(walk) => walk != CellWalk::Passes,
            Traversal::Passes | Traversal::Slices(_) | Traversal::Shells => false,
        }
    }

    /// How its slices lie; none where it has none.
    pub fn stack(&self) -> Option<Stack> {
        match self.traversal {
            Traversal::Slices(stack) => Some(stack),
            _ => None,
        }
    }

    /// Whether its picture is made of samples: those of other methods differ from it by more than samples of another step do.
    pub fn takes_samples(&self) -> bool {
        !matches!(self.traversal, Traversal::Shells | Traversal::Cells(_))
    }

    /// Whether its rays go through the cells of a mesh.
    pub fn goes_through_cells(&self) -> bool {
        matches!(self.traversal, Traversal::Cells(_))
    }

    /// Whether slices are drawn back to front, all of them in one pass.
    pub fn back_to_front(&self) -> bool {
        self.stack().is_some() && !self.ends_rays
    }

    /// The method with the same samples that skips nothing: itself, where it skips nothing.
    pub fn unskipped(&'static self) -> &'static Method {
        self.skips_of.unwrap_or(self)
    }
}

impl std::fmt::Debug for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "Method({})", self.name)
    }
}

/// Why a frame lacks something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Why {
    /// In words, for the list of what was left out.
    Because(String),
    /// Nobody would expect it: it is part of something else that is left out, or another feature stands in its place.
    Untold,
}

impl From<&str> for Why {
    fn from(reason: &str) -> Self {
        Self::Because(reason.to_owned())
    }
}

impl From<String> for Why {
    fn from(reason: String) -> Self {
        Self::Because(reason)
    }
}

/// The place in a shader where a feature does its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hook {
    /// Where it is known between which depths a ray is drawn at all.
    Interval,
    /// Where it is known which part of a ray is drawn.
    Ray,
    /// Where it is known which surface ends that part.
    RayEnd,
    /// Where samples are taken and classified.
    Sample,
    /// Where surfaces are lit, once for all rays.
    Light,
    /// Where it is decided which rays go on.
    Decide,
    /// In the frame as a whole: steps are there or not.
    Frame,
}

/// Something a frame may have. It is asked once, and the answer is the plan as well as the line "left out: why".
pub struct Feature {
    /// What is left out, as plans and reports name it.
    pub name: &'static str,
    /// Whether the frame has it, else why not.
    pub needed: fn(&Context) -> Result<(), Why>,
    /// Where in a shader it works.
    pub at: Hook,
    /// The define of shaders that have it.
    pub with: Option<&'static str>,
    /// The define of shaders that lack it.
    pub without: Option<&'static str>,
    /// Specialization constants, whether the frame has it or not.
    pub constants: fn(&Context) -> Vec<Constant>,
    /// What shaders read that have it.
    pub reads: fn(&Context) -> Vec<Resource>,
    /// Whether ways through cells are classified by it, too.
    pub of_cells: bool,
}

impl Feature {
    /// A feature of the frame as a whole, without anything in shaders.
    pub const fn of_frame(name: &'static str, needed: fn(&Context) -> Result<(), Why>) -> Self {
        Self {
            name,
            needed,
            at: Hook::Frame,
            with: None,
            without: None,
            constants: |_| Vec::new(),
            reads: |_| Vec::new(),
            of_cells: false,
        }
    }

    /// The define that this feature asks for of a shader at its hook.
    pub fn define(&self, context: &Context) -> Option<&'static str> {
        if context.has(self) { self.with } else { self.without }
    }

    /// A feature of shaders at a hook.
    pub const fn at(at: Hook, name: &'static str, needed: fn(&Context) -> Result<(), Why>) -> Self {
        Self { at, ..Self::of_frame(name, needed) }
    }
}

/// All that the steps of a frame follow from.
pub struct Context<'a> {
    pub scene: &'a Scene,
    pub view: &'a View,
    pub method: &'static Method,
    /// Cull and mark, where the method culls at all.
    pub form: Option<Form>,
    /// N, main passes.
    pub passes: u32,
    /// Depth layers of transparent polygons and of clip geometry, at the most; 0 where there are no such polygons.
    pub layers: u32,
    /// Whether there are transparent polygons, so that layers have colours.
    pub blends: bool,
    /// Whether there are opaque polygons.
    pub opaque: bool,
    /// The part of each ray that is drawn: that behind so many layers.
    pub section: u32,
    /// Answers of features that were asked before, by their names: some go through the whole volume.
    answers: RefCell<HashMap<&'static str, Result<(), Why>>>,
}

impl<'a> Context<'a> {
    pub fn new(scene: &'a Scene, view: &'a View, method: &'static Method, form: Option<Form>, passes: u32) -> Self {
        let polygons = &scene.polygons;
        let layers = if polygons.peeled().is_empty() { 0 } else { scene.settings.layers.most };
        let (blends, opaque) = (!polygons.transparent().is_empty(), !polygons.opaque().is_empty());
        Self { scene, view, method, form, passes, layers, blends, opaque, section: 0, answers: RefCell::default() }
    }

    /// The parts of rays that are drawn one after the other, from `first` on: the one in front of all layers is the part 0.
    pub fn sections(&self, first: u32) -> impl Iterator<Item = Self> {
        (first..=self.layers).map(|section| Self {
            section,
            answers: self.answers.clone(),
            scene: self.scene,
            view: self.view,
            method: self.method,
            form: self.form,
            passes: self.passes,
            layers: self.layers,
            blends: self.blends,
            opaque: self.opaque,
        })
    }

    /// The main passes that draw anything, in their order: all, unless tiles are left out.
    pub fn drawn_passes(&self) -> impl Iterator<Item = u32> {
        let tiles = self.view.tiles.as_deref().filter(|_| self.plans());
        (0..self.passes).filter(move |pass| tiles.is_none_or(|tiles| !tiles.live_in(*pass).is_empty()))
    }

    /// Whether the frame has a feature.
    pub fn has(&self, feature: &Feature) -> bool {
        self.answer(feature).is_ok()
    }

    /// Whether the frame has a feature, else why not.
    pub fn answer(&self, feature: &Feature) -> Result<(), Why> {
        let of_cells = self.method.goes_through_cells() && feature.of_cells;
        if matches!(feature.at, Hook::Ray | Hook::Sample) && !self.method.takes_samples() && !of_cells {
            return Err(Why::Untold);
        }
        // It differs from part to part of a ray, and is soon answered.
        if matches!(feature.at, Hook::Ray | Hook::RayEnd) {
            return (feature.needed)(self);
        }
        if let Some(known) = self.answers.borrow().get(feature.name) {
            return known.clone();
        }
        let answer = (feature.needed)(self);
        self.answers.borrow_mut().insert(feature.name, answer.clone());
        answer
    }

    /// Whether what the scene does not need is left out.
    pub fn plans(&self) -> bool {
        self.scene.settings.method.planner
    }

    /// How the samples of a ray become its pixel.
    pub fn projection(&self) -> &'static Projection {
        projection::of(&self.scene.settings)
    }

    /// How a sample, or a layer, goes into what is drawn already.
    pub fn blend(&self) -> Blend {
        match self.projection().blend {
            Blend::Over if self.method.back_to_front() => Blend::InFront,
            blend => blend,
        }
    }

    /// What the method looks up of what lies ahead; none where it looks up no distances.
    pub fn lookup(&self) -> Option<Lookup> {
        self.method.distance().map(|distance| Lookup::new(self.scene, distance))
    }
}
