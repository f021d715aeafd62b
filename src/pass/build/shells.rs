//! Marching cubes for a level: sides of nodes, edges with a vertex, how many vertices and triangles come before each word of nodes, and
//! these themselves. Only the last step takes memory that grows with the surface, of which it is known by then how much.

use super::dispatch;
use crate::glsl::Shader;
use crate::part::Step;
use crate::part::resource::Facts;
use crate::resource;
use crate::resource::texels::threshold;
use crate::resource::{SUMMED, lattice_words, sum_counts};
use crate::scene::shells::{Faces, Lattice};
use crate::scene::texture::{TextureChoice, TextureMap};
use crate::shared::Slice;

/// Nodes in a word of bits.
const NODES: usize = u32::BITS as usize;

/// The steps for a shell, by its number from the dimmest on.
pub fn shell(facts: &Facts, number: u16) -> Vec<Step> {
    let Some(all) = slice(facts, number) else { return Vec::new() };
    let holes = facts.scene.field.holes.is_some();
    let shader = |file| Shader::new(file, holes.then_some("HOLES"));
    let with_holes = |mut reads: Vec<_>| {
        reads.extend(holes.then_some(("holes", resource::HOLES)));
        reads
    };
    let name = |step: &str| format!("{step} #{number}");
    let sides = ("shell_sides", resource::SHELL_SIDES);
    let edges = ("shell_edges", resource::SHELL_EDGES);
    let sums = ("shell_sums", resource::SHELL_SUMS);
    let cases = ("shell_cases", resource::SHELL_CASES);
    let volume = ("volume", resource::VOLUME);
    let mut steps = vec![
        dispatch(name("shell_sides"), Shader::new("structure/shell_sides.comp", []), &[volume], &[sides], all, NODES),
        dispatch(
            name("shell_edges"),
            shader("structure/shell_edges.comp"),
            &with_holes(vec![sides, cases]),
            &[edges, sums],
            all,
            NODES,
        ),
    ];
    let mut first = 0;
    for (level, count) in sum_counts(&facts.scene.field).into_iter().enumerate() {
        let chunks = count.div_ceil(SUMMED);
        let slice = Slice {
            end: chunks as u32,
            inner: first as u32,
            outer: (first + count) as u32,
            stride: count as u32,
            ..Slice::default()
        };
        let shader = Shader::new("structure/shell_sums.comp", []);
        steps.push(dispatch(name(&format!("shell_sums.{level}")), shader, &[], &[sums], slice, SUMMED));
        first += count;
    }
    let polygons = ("shell_polygons", resource::SHELL_POLYGONS.at(number));
    let reads = with_holes(vec![volume, sides, edges, sums, cases]);
    let shader = shader("structure/shell_polygons.comp");
    steps.push(dispatch(name("shell_polygons"), shader, &reads, &[polygons], all, NODES));
    steps.iter_mut().for_each(|step| step.pass = number.into());
    steps
}

/// What the steps know of the lattice and of the level.
fn slice(facts: &Facts, number: u16) -> Option<Slice> {
    let field = &facts.scene.field;
    let shell = facts.scene.shells.as_ref()?.list.get(usize::from(number))?;
    let kept = TextureChoice::of(facts.scene).kept;
    let TextureMap { scale, offset } = TextureMap::of(field, kept);
    let [cells_x, cells_y, cells_z] = Lattice::new(field, Faces::Closed).nodes().map(|n| n as u32);
    let [voxel_x, voxel_y, voxel_z] = field.voxel().as_vec3().to_array();
    Some(Slice {
        end: lattice_words(field) as u32,
        cells_x,
        cells_y,
        cells_z,
        corners: shell.count(field)[0],
        level: (scale * f64::from(shell.emission as f32) + offset) as f32,
        threshold: threshold(field, kept, shell.emission as f32),
        voxel_x,
        voxel_y,
        voxel_z,
        ..Slice::default()
    })
}

/// The polygons of a shell as the host makes them.
pub fn polygons(facts: &Facts, number: u16) -> Vec<u8> {
    let shells = facts.scene.shells.as_ref();
    let Some(shell) = shells.and_then(|shells| shells.list.get(usize::from(number))) else { return Vec::new() };
    let mesh = shell.polygons(&facts.scene.field);
    [bytemuck::cast_slice::<_, u8>(&mesh.corners), bytemuck::cast_slice(&mesh.triangles)].concat()
}
