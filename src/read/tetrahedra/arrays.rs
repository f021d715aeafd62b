//! Values at points or at cells, of which one array is shown.

use std::path::Path;

use crate::error::{Error, Result};
use crate::read::pick::LUMINANCE;
use crate::scene::builtin::nearest;
use crate::scene::settings::Component;

/// Where values are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    Points,
    Cells,
}

/// Values, so many for each point or cell.
#[derive(Debug)]
pub struct Array {
    pub name: String,
    pub at: At,
    pub components: usize,
    pub values: Vec<f64>,
}

/// The array of that name, else the first with one value a point, else the first with one a cell, else the first.
///
/// # Errors
/// When there is none, with those there are.
pub fn pick<'a>(path: &Path, arrays: &'a [Array], name: Option<&str>) -> Result<&'a Array> {
    let names = || arrays.iter().map(|array| array.name.as_str());
    let known = || names().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    if let Some(name) = name {
        return arrays.iter().find(|array| array.name == name).ok_or_else(|| {
            let near = nearest(name, names()).map_or(String::new(), |near| format!("did you mean `{near}`? "));
            let problem = format!("is `{}`, which is not in {}", name.escape_debug(), path.display());
            Error::input("volume.array (--array)", problem, format!("{near}its arrays are {}", known()))
        });
    }
    let scalar = |at: At| arrays.iter().find(|array| array.components == 1 && array.at == at);
    scalar(At::Points).or_else(|| scalar(At::Cells)).or(arrays.first()).ok_or_else(|| {
        Error::input(
            path.display(),
            "has no values at its points or cells",
            "give a file with an array of numbers there",
        )
    })
}

impl Array {
    /// One value for each point or cell.
    ///
    /// # Errors
    /// When it is not said which of several, or there is none of that number.
    pub fn scalars(&self, component: Option<Component>) -> Result<Vec<f64>> {
        let rows = || self.values.chunks_exact(self.components);
        let refused =
            |problem: String, remedy: String| Err(Error::input("volume.component (--component)", problem, remedy));
        let Self { name, components, .. } = self;
        match component {
            None | Some(Component::Number(0)) if *components == 1 => Ok(self.values.clone()),
            None => {
                let problem = format!("is not given, and the array `{name}` has {components} values each");
                refused(problem, format!("give a number from 0 to {}, or magnitude", components - 1))
            }
            Some(Component::Number(number)) if number < *components => Ok(rows().map(|row| row[number]).collect()),
            Some(Component::Magnitude) => Ok(rows().map(|row| row.iter().copied().fold(0.0, f64::hypot)).collect()),
            Some(Component::Luminance) if *components >= LUMINANCE.len() => {
                Ok(rows().map(|row| row.iter().zip(LUMINANCE).map(|(value, part)| value * part).sum()).collect())
            }
            Some(other) => {
                let problem = format!("is {other}, and the array `{name}` has {components} values each");
                refused(problem, "give a number below that, or magnitude".to_owned())
            }
        }
    }
}
