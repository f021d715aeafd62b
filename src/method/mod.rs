//! The render methods: [`METHODS`] is the one list of them.
//!
//! To add one: a file here with its row, a line in [`METHODS`], its passes in `crate::pass` with their shaders and f64 twins,
//! and the golden plan that a test over [`METHODS`] asks for.

mod cpu;
mod fused;
mod near_neighbor;
mod rc;
mod rc_block;
mod rc_ert;
mod rows;
mod shells;
mod single_pass;
mod slices;
mod tetrahedra;

pub use cpu::CPU;
pub use fused::{NN_CONE_FUSED, NN_DIRECTIONAL_FUSED, NN_OMNI_FUSED, NN_OPTIMAL_FUSED};
pub use near_neighbor::{NN_CONE, NN_DIRECTIONAL, NN_OMNI, NN_OPTIMAL};
pub use rc::RC;
pub use rc_block::RC_BLOCK;
pub use rc_ert::RC_ERT;
pub use shells::SHELLS;
pub use single_pass::{
    SINGLE_PASS, SINGLE_PASS_BLOCK, SINGLE_PASS_BLOCK_COMPUTE, SINGLE_PASS_COMPUTE, SINGLE_PASS_DIRECTIONAL,
    SINGLE_PASS_DIRECTIONAL_COMPUTE, SINGLE_PASS_OMNI, SINGLE_PASS_OMNI_COMPUTE,
};
pub use slices::{
    SLICES_2D, SLICES_2D_BLOCK, SLICES_2D_FTB, SLICES_2D_OMNI, SLICES_3D, SLICES_3D_BLOCK, SLICES_3D_FTB,
    SLICES_3D_OMNI, SLICES_SHELLS, SLICES_SHELLS_BLOCK, SLICES_SHELLS_FTB, SLICES_SHELLS_OMNI,
};

pub use tetrahedra::{TET_PROPAGATION, TET_SINGLE_PASS, TET_SINGLE_PASS_COMPUTE};

use std::str::FromStr;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::error::{Error, Result};
use crate::part::form::Form;
use crate::part::rows::Method;
use crate::scene::Scene;
use crate::scene::settings::MethodName;

/// Every method, in the order of tables and of the help.
pub const METHODS: [&Method; 36] = [
    &RC,
    &RC_ERT,
    &RC_BLOCK,
    &NN_OMNI,
    &NN_DIRECTIONAL,
    &NN_OPTIMAL,
    &NN_CONE,
    &NN_OMNI_FUSED,
    &NN_DIRECTIONAL_FUSED,
    &NN_OPTIMAL_FUSED,
    &NN_CONE_FUSED,
    &SINGLE_PASS,
    &SINGLE_PASS_BLOCK,
    &SINGLE_PASS_OMNI,
    &SINGLE_PASS_DIRECTIONAL,
    &SINGLE_PASS_COMPUTE,
    &SINGLE_PASS_BLOCK_COMPUTE,
    &SINGLE_PASS_OMNI_COMPUTE,
    &SINGLE_PASS_DIRECTIONAL_COMPUTE,
    &SLICES_2D,
    &SLICES_2D_FTB,
    &SLICES_2D_BLOCK,
    &SLICES_2D_OMNI,
    &SLICES_3D,
    &SLICES_3D_FTB,
    &SLICES_3D_BLOCK,
    &SLICES_3D_OMNI,
    &SLICES_SHELLS,
    &SLICES_SHELLS_FTB,
    &SLICES_SHELLS_BLOCK,
    &SLICES_SHELLS_OMNI,
    &SHELLS,
    &TET_PROPAGATION,
    &TET_SINGLE_PASS,
    &TET_SINGLE_PASS_COMPUTE,
    &CPU,
];

impl Method {
    /// The name as settings have it.
    pub const fn name(&self) -> MethodName {
        MethodName::new(self.name)
    }
}

/// The method of that name; none where there is none. Where nothing has chosen for `auto` it is the thesis' own.
pub fn find(name: MethodName) -> Option<&'static Method> {
    if name.is_auto() {
        return Some(&NN_OMNI);
    }
    METHODS.into_iter().find(|method| method.name == name.name())
}

/// The method of that name.
///
/// # Errors
/// A name that no method has. Names are checked when they are read, so that this is a fault of the program.
pub fn of(name: MethodName) -> Result<&'static Method> {
    find(name).ok_or_else(|| Error::usage(format!("--method {name}"), "there is no such method", "please report this"))
}

/// Whether the method of that name draws a scene.
pub fn takes(name: MethodName, scene: &Scene) -> bool {
    let mut scene = scene.clone();
    scene.settings.method.name = name;
    find(name).is_some_and(|method| (method.takes)(&scene).is_ok())
}

/// The methods that go through the cells of a mesh.
pub fn of_cells() -> Vec<MethodName> {
    METHODS.into_iter().filter(|method| method.goes_through_cells()).map(Method::name).collect()
}

/// Whether the picture of the method of that name is made of samples.
pub fn takes_samples(name: MethodName) -> bool {
    find(name).is_none_or(Method::takes_samples)
}

/// The names of all methods, in their order, behind that of the choice among them.
const NAMES: [&str; METHODS.len() + 1] = {
    let mut names = [MethodName::AUTO.name(); METHODS.len() + 1];
    let mut i = 0;
    while i < METHODS.len() {
        names[i + 1] = METHODS[i].name;
        i += 1;
    }
    names
};

impl<'de> Deserialize<'de> for MethodName {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        name.parse().map_err(|_| D::Error::unknown_variant(&name, &NAMES))
    }
}

impl FromStr for MethodName {
    type Err = String;

    fn from_str(name: &str) -> std::result::Result<Self, String> {
        let auto = (name == Self::AUTO.name()).then_some(Self::AUTO);
        let row = METHODS.iter().find(|method| method.name == name);
        auto.or_else(|| row.map(|method| method.name())).ok_or_else(|| format!("is not one of {}", NAMES.join(", ")))
    }
}

/// The form that `auto` stands for where nothing is known of the device: that of the papers; none for a method that culls
/// nothing.
pub fn papers_form(name: MethodName) -> Option<Form> {
    find(name).and_then(|method| method.papers)
}

/// The forms that a method has on a device; none for one that culls nothing there.
pub fn forms(name: MethodName) -> Vec<Form> {
    find(name).map_or_else(Vec::new, |method| (method.forms)())
}
