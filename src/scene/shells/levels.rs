//! The shells of a scene: their levels, and what each of them emits [Heidrich95 §2].

use std::sync::{Arc, OnceLock};

use glam::DVec3;

use super::crossings::Crossings;
use super::lattice::Faces;
use super::polygons::{crosses, polygons};
use crate::error::{Error, Result};
use crate::math::bvh::{Bounds, Hierarchy};
use crate::scene::Field;
use crate::scene::mesh::Mesh;
use crate::scene::settings::{ShellMode, ShellsSettings};

/// Shells by rising emission, but for those whose level no value reaches.
#[derive(Clone, Debug)]
pub struct Shells {
    pub mode: ShellMode,
    /// The shells, the dimmest first.
    pub list: Vec<Shell>,
    /// Levels that no value reaches, in the volume's own unit.
    pub empty: Vec<f64>,
    /// Levels that are left out for now, in the volume's own unit.
    pub disabled: Vec<f64>,
    /// How many of the levels that were given are given again.
    pub repeated: usize,
}

/// A shell.
#[derive(Clone, Debug)]
pub struct Shell {
    /// In the volume's own unit.
    pub level: f64,
    /// phi: the level as x.
    pub emission: f64,
    /// By how much the emission within the shell exceeds that of what is around it, where ways are summed up: emissions change half-way
    /// between two levels.
    pub rise: f64,
    pub mesh: Arc<ShellMesh>,
}

/// The polygons of a level, closed at the faces of the volume, counted and made when they are first asked for.
#[derive(Debug, Default)]
pub struct ShellMesh {
    count: OnceLock<[u32; 2]>,
    mesh: OnceLock<Mesh>,
    /// Over its triangles, for who asks where rays meet them.
    hierarchy: OnceLock<Hierarchy>,
}

impl Shell {
    /// Its triangles.
    pub fn polygons(&self, field: &Field) -> &Mesh {
        self.mesh.mesh.get_or_init(|| polygons(field, self.emission as f32, Faces::Closed).unwrap_or_default())
    }

    /// Its vertices and its triangles, counted before any of them is made; none where they cannot be counted, which
    /// [`Shells::count`] says.
    pub fn count(&self, field: &Field) -> [u32; 2] {
        let known = self.mesh.count.get().copied();
        known
            .or_else(|| self.counted(field).ok().map(|counted| *self.mesh.count.get_or_init(|| counted)))
            .unwrap_or_default()
    }

    fn counted(&self, field: &Field) -> Result<[u32; 2]> {
        let level = self.emission as f32;
        match self.mesh.mesh.get() {
            Some(made) => Ok([made.corners.len(), made.triangles.len()].map(|count| count as u32)),
            None if crosses(field, level, Faces::Closed) => Ok(Crossings::new(field, level, Faces::Closed)?.count),
            None => Ok([0; 2]),
        }
    }

    /// The corners of a triangle.
    pub fn triangle(&self, field: &Field, number: usize) -> [DVec3; 3] {
        let mesh = self.polygons(field);
        mesh.triangles[number].map(|corner| DVec3::from_array(mesh.corners[corner as usize].map(f64::from)))
    }

    /// The boxes around its triangles.
    pub fn hierarchy(&self, field: &Field) -> &Hierarchy {
        self.mesh.hierarchy.get_or_init(|| {
            let count = self.polygons(field).triangles.len();
            let boxes: Vec<Bounds> = (0..count).map(|number| Bounds::around(self.triangle(field, number))).collect();
            Hierarchy::new(&boxes)
        })
    }
}

impl Shells {
    /// The shells that settings ask for; none where they ask for none. Shells of `before`, which are those of the same field, are taken
    /// over where a level stays.
    ///
    /// # Errors
    /// When an emission is below 0, or `disabled` has a number that no shell has.
    pub fn new(settings: &ShellsSettings, field: &Field, before: Option<&Self>) -> Result<Option<Self>> {
        let Some(mode) = settings.mode else { return Ok(None) };
        let mut levels = match settings.shell_levels.as_slice() {
            [] => in_the_middle(settings.count as usize, field.range),
            levels => levels.to_vec(),
        };
        levels.sort_by(f64::total_cmp);
        let asked = levels.len();
        levels.dedup();
        let repeated = if settings.shell_levels.is_empty() { 0 } else { asked - levels.len() };
        let shown = enabled(&levels, &settings.disabled)?;
        let emissions: Vec<f64> = shown.iter().map(|level| f64::from(field.x(*level))).collect();
        let emits = mode != ShellMode::Surface;
        if let Some(below) = emissions.iter().position(|emission| emits && *emission < 0.0) {
            return Err(Error::usage(
                "shells.levels (--shell-levels)",
                format!("has the level {}, which is below {}, where emission is 0", shown[below], field.range[0]),
                format!("give levels from {} on, or another --range", field.range[0]),
            ));
        }
        let [_, greatest] = field.extremes();
        let rises = rises(&emissions, f64::from(greatest));
        let disabled = levels.iter().filter(|level| !shown.contains(level)).copied().collect();
        let mut shells = Self { mode, list: Vec::new(), empty: Vec::new(), disabled, repeated };
        for ((level, emission), rise) in shown.into_iter().zip(&emissions).zip(rises) {
            let known = before.and_then(|before| before.list.iter().find(|shell| shell.level == level));
            let mesh = known.map_or_else(Arc::default, |shell| shell.mesh.clone());
            match *emission > f64::from(greatest) {
                true => shells.empty.push(level),
                false => shells.list.push(Shell { level, emission: *emission, rise, mesh }),
            }
        }
        Ok(Some(shells))
    }

    /// The vertices and the triangles of a shell, by its number from the dimmest on; none where there is no such shell.
    pub fn count_of(&self, number: usize, field: &Field) -> [u32; 2] {
        self.list.get(number).map_or([0; 2], |shell| shell.count(field))
    }

    /// Counts the polygons that were not counted yet.
    ///
    /// # Errors
    /// When a shell has more than 32 bits count, or there is not enough memory to count them.
    pub fn count(&self, field: &Field) -> Result<()> {
        for shell in self.drawn() {
            let counted = match shell.mesh.count.get() {
                Some(counted) => *counted,
                None => shell.counted(field)?,
            };
            if 3 * u64::from(counted[1]) > u64::from(u32::MAX) {
                return Err(Error::input(
                    &field.volume.name,
                    format!(
                        "has a shell of {} triangles at {}, whose corners 32 bits do not count",
                        counted[1], shell.level
                    ),
                    "choose another level",
                ));
            }
            shell.mesh.count.get_or_init(|| counted);
        }
        Ok(())
    }

    /// Whether there is a shell at a level, or one that is left out for now.
    pub fn has(&self, level: f64) -> bool {
        self.list.iter().any(|shell| shell.level == level)
            || self.disabled.contains(&level)
            || self.empty.contains(&level)
    }

    /// The level of the outermost shell, whether any value reaches it or not; none where all shells are left out.
    pub fn outermost(&self) -> Option<f64> {
        self.list.first().map(|shell| shell.level).or_else(|| self.empty.first().copied())
    }

    /// The shells that are drawn: all of them, or the outermost one.
    pub fn drawn(&self) -> &[Shell] {
        let count = if self.mode == ShellMode::Surface { 1 } else { self.list.len() };
        &self.list[..count.min(self.list.len())]
    }

    /// Triangles of the shells that are drawn: where all values about a level are missing there are none.
    pub fn triangles(&self, field: &Field) -> u64 {
        self.drawn().iter().map(|shell| u64::from(shell.count(field)[1])).sum()
    }

    /// What a user should know of them.
    pub fn warnings(&self, field: &Field) -> Vec<String> {
        let list = |levels: &[f64]| levels.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        let repeated = (self.repeated > 0).then(|| "a level of shells that is given again is drawn once".to_owned());
        let [low, high] = field.value_extremes().unwrap_or(field.range);
        let empty = (!self.empty.is_empty()).then(|| {
            format!(
                "shells at {} are left out, which no value reaches; values go from {low} to {high}",
                list(&self.empty)
            )
        });
        repeated.into_iter().chain(empty).collect()
    }
}

/// So many levels in the middle of equal parts of a range.
pub fn in_the_middle(count: usize, [low, high]: [f64; 2]) -> Vec<f64> {
    let middle = |i: usize| {
        let part = (i as f64 + 0.5) / count as f64;
        // Not by the difference, which may overflow.
        low * (1.0 - part) + high * part
    };
    (0..count).map(middle).collect()
}

/// The levels without those that are left out by their numbers.
fn enabled(levels: &[f64], disabled: &[u32]) -> Result<Vec<f64>> {
    if let Some(odd) = disabled.iter().find(|number| !(1..=levels.len()).contains(&(**number as usize))) {
        return Err(Error::usage(
            "shells.disabled (--shell-disabled)",
            format!("has the number {odd}, and there are {} shells", levels.len()),
            "give numbers from 1 on, the dimmest shell first",
        ));
    }
    let numbered = levels.iter().enumerate();
    Ok(numbered.filter(|(i, _)| !disabled.contains(&(*i as u32 + 1))).map(|(_, level)| *level).collect())
}

/// What each emission adds to those below: values between two levels count as half-way between them, and those above the last one as far
/// above it as those below are below, but not beyond the greatest value.
fn rises(emissions: &[f64], greatest: f64) -> Vec<f64> {
    let (mut within, mut rises) = (0.0, Vec::with_capacity(emissions.len()));
    for (i, emission) in emissions.iter().enumerate() {
        let next = match emissions.get(i + 1) {
            Some(above) => 0.5 * (emission + above),
            None => (2.0 * emission - within).min(greatest.max(*emission)),
        };
        rises.push(next - within);
        within = next;
    }
    rises
}
