//! Structs that Rust and the shaders both know: every member has the same name, offset and size on both sides.

mod random;

#[path = "glsl/asked.rs"]
mod asked;
#[path = "shared/transfer.rs"]
mod transfer;

use std::collections::HashMap;
use std::mem::offset_of;
use std::sync::LazyLock;

use bytemuck::Zeroable;
use depthleap::glsl::compile::{CompiledModule, compile_unoptimised};
use depthleap::glsl::{self, Shader};
use depthleap::shared::{AxisPiece, Bundle, ClipPlane, Frame, PushStep, SingleRays, Slice, SliceCut, Slices, TetView};
use rayon::prelude::*;
use rspirv::dr::{Instruction, Module, Operand, load_words};
use rspirv::spirv::{Decoration, Op};

/// A struct as one side has it.
#[derive(Clone, Debug, PartialEq)]
struct Layout {
    members: Vec<Member>,
    /// From one to the next.
    bytes: usize,
}

#[derive(Clone, Debug, PartialEq)]
struct Member {
    name: String,
    offset: usize,
    bytes: usize,
}

/// Does not compile unless all members are named.
macro_rules! layout {
    ($kind:ident { $($member:ident),* $(,)? }) => {{
        let $kind { $($member),* } = $kind::zeroed();
        let members = vec![$(Member {
            name: stringify!($member).to_owned(),
            offset: offset_of!($kind, $member),
            bytes: size_of_val(&$member),
        }),*];
        Layout { members, bytes: size_of::<$kind>() }
    }};
}

fn frame() -> Layout {
    layout!(Frame {
        origin,
        base,
        right,
        down,
        extent,
        inverse_extent,
        voxel_step,
        dims,
        near,
        inverse_step,
        offset,
        termination,
        exponent,
        step_voxels,
        passes,
        first_column,
        first_row,
        x_scale,
        x_offset,
        start,
        end,
    })
}

fn step() -> Layout {
    layout!(PushStep { bound, pass })
}

fn slice() -> Layout {
    layout!(Slice {
        first,
        end,
        cells_x,
        cells_y,
        cells_z,
        cell,
        inner,
        outer,
        stride,
        weight,
        reach,
        octant,
        corners,
        level,
        threshold,
        voxel_x,
        voxel_y,
        voxel_z
    })
}

fn bundle() -> Layout {
    layout!(Bundle { from, sides, low, high, spread, short_step })
}

fn axis_piece() -> Layout {
    layout!(AxisPiece { begin, inverse_length, first, intervals })
}

fn clip_plane() -> Layout {
    layout!(ClipPlane { heights, plane })
}

fn single_rays() -> Layout {
    layout!(SingleRays { place, place_right, place_down, heading, heading_right, heading_down, center, near })
}

fn slices() -> Layout {
    layout!(Slices { first, spacing, steps, count })
}

fn tet_view() -> Layout {
    layout!(TetView { table, square, near, middle, corner, slope, depth })
}

fn slice_cut() -> Layout {
    layout!(SliceCut { reach, x, y, w, normal, first, beyond, spacing })
}

/// What differs, one line each.
fn differences(rust: &Layout, shader: &Layout) -> Vec<String> {
    let mut found = Vec::new();
    if rust.members.len() != shader.members.len() {
        found.push(format!("{} members and {}", rust.members.len(), shader.members.len()));
    }
    if rust.bytes != shader.bytes {
        found.push(format!("{} bytes and {}", rust.bytes, shader.bytes));
    }
    let pairs = rust.members.iter().zip(&shader.members).filter(|(a, b)| a != b);
    found.extend(pairs.map(|(a, b)| format!("{a:?} and {b:?}")));
    found
}

/// Types of a module by their ids.
struct Types<'a> {
    module: &'a Module,
    by_id: HashMap<u32, &'a Instruction>,
}

impl<'a> Types<'a> {
    fn of(module: &'a Module) -> Self {
        let by_id = module.types_global_values.iter().filter_map(|one| Some((one.result_id?, one))).collect();
        Self { module, by_id }
    }

    fn number(&self, id: u32, operand: usize) -> usize {
        match self.by_id[&id].operands[operand] {
            Operand::LiteralBit32(number) => number as usize,
            Operand::IdRef(constant) => self.number(constant, 0),
            ref other => panic!("{other:?} is no number"),
        }
    }

    fn element(&self, id: u32) -> u32 {
        self.by_id[&id].operands[0].unwrap_id_ref()
    }

    /// The value of a decoration, of a type or of its member.
    fn decoration(&self, id: u32, member: Option<u32>, wanted: Decoration) -> Option<usize> {
        self.module.annotations.iter().find_map(|one| match (one.class.opcode, &*one.operands, member) {
            (Op::Decorate, [Operand::IdRef(of), Operand::Decoration(what), Operand::LiteralBit32(value)], None)
                if (*of, *what) == (id, wanted) =>
            {
                Some(*value as usize)
            }
            (
                Op::MemberDecorate,
                [
                    Operand::IdRef(of),
                    Operand::LiteralBit32(at),
                    Operand::Decoration(what),
                    Operand::LiteralBit32(value),
                ],
                Some(member),
            ) if (*of, *at, *what) == (id, member, wanted) => Some(*value as usize),
            _ => None,
        })
    }

    fn bytes(&self, id: u32) -> usize {
        match self.by_id[&id].class.opcode {
            Op::TypeFloat | Op::TypeInt => self.number(id, 0) / 8,
            Op::TypeVector => self.bytes(self.element(id)) * self.number(id, 1),
            Op::TypeArray => self.decoration(id, None, Decoration::ArrayStride).unwrap() * self.number(id, 1),
            other => panic!("no member is of type {other:?}"),
        }
    }

    /// The struct of that name, with the stride of arrays of it, if it is in any.
    fn layout(&self, name: &str) -> Option<Layout> {
        let named = |one: &&Instruction| one.operands.get(1) == Some(&Operand::LiteralString(name.to_owned()));
        let names = self.module.debug_names.iter().filter(|one| one.class.opcode == Op::Name).filter(named);
        // The compiler makes a second struct without offsets where a shader copies one.
        let id = names
            .map(|one| one.operands[0].unwrap_id_ref())
            .find(|&id| self.decoration(id, Some(0), Decoration::Offset).is_some())?;
        let kinds = self.by_id[&id].operands.iter().map(Operand::unwrap_id_ref);
        let members: Vec<Member> = kinds
            .enumerate()
            .map(|(at, kind)| Member {
                name: self.member_name(id, at as u32),
                offset: self.decoration(id, Some(at as u32), Decoration::Offset).unwrap(),
                bytes: self.bytes(kind),
            })
            .collect();
        let arrays = self.by_id.iter().filter(|(_, one)| {
            one.class.opcode == Op::TypeRuntimeArray && one.operands.first() == Some(&Operand::IdRef(id))
        });
        let strides: Vec<usize> =
            arrays.filter_map(|(&array, _)| self.decoration(array, None, Decoration::ArrayStride)).collect();
        let end = members.iter().map(|one| one.offset + one.bytes).max()?;
        Some(Layout { members, bytes: strides.first().copied().unwrap_or(end) })
    }

    fn member_name(&self, id: u32, at: u32) -> String {
        let wanted = [Operand::IdRef(id), Operand::LiteralBit32(at)];
        let named = |one: &&Instruction| one.class.opcode == Op::MemberName && one.operands.starts_with(&wanted);
        self.module.debug_names.iter().find(named).unwrap().operands[2].unwrap_literal_string().to_owned()
    }
}

/// The structs that both sides know.
const STRUCTS: [&str; 9] =
    ["Frame", "Step", "SingleRays", "Slice", "Slices", "Bundle", "ClipPlane", "AxisPiece", "TetView"];

/// A module's name, and those of the structs that it has.
type Known = (String, Vec<(&'static str, Layout)>);

/// The struct in every module that the program may ask for and that has it.
fn in_shaders(name: &str) -> Vec<(String, Layout)> {
    static ASKED: LazyLock<Vec<Known>> = LazyLock::new(|| {
        let known = |(shader, made): (Shader, CompiledModule)| {
            let module = load_words(&made.words).unwrap();
            let types = Types::of(&module);
            let layouts = STRUCTS.iter().filter_map(|name| Some((*name, types.layout(name)?))).collect();
            (shader.to_string(), layouts)
        };
        asked::unoptimised().map(known).collect()
    });
    assert!(STRUCTS.contains(&name), "{name}");
    let of_name = |(module, layouts): &Known| {
        let (_, layout) = layouts.iter().find(|(one, _)| *one == name)?;
        Some((module.clone(), layout.clone()))
    };
    ASKED.iter().filter_map(of_name).collect()
}

#[track_caller]
fn assert_alike(name: &str, rust: &Layout, at_least_in: &str) {
    let found = in_shaders(name);
    assert!(found.iter().any(|(module, _)| module == at_least_in), "{at_least_in} has no {name}");
    for (module, shader) in found {
        assert_eq!(differences(rust, &shader), [""; 0], "{name} in Rust and in {module}");
    }
}

#[test]
fn frame_is_alike_in_rust_and_in_every_shader() {
    assert_alike("Frame", &frame(), "main_pass.frag");
    assert_alike("Frame", &frame(), "entry.frag");
}

#[test]
fn step_is_alike_in_rust_and_in_every_shader() {
    assert_alike("Step", &step(), "near_neighbor.frag:CULL_DISCARD+MARK_COPY");
}

#[test]
fn slice_is_alike_in_rust_and_in_every_shader() {
    assert_alike("Slice", &slice(), "structure/distance_scan.comp:OCTANT");
}

#[test]
fn slices_are_alike_in_rust_and_in_every_shader() {
    assert_alike("Slices", &slices(), "termination.frag:MARK_COPY+SLICES");
}

#[test]
fn slice_cut_is_alike_in_rust_and_in_the_vertex_shader() {
    let text = glsl::built_in().text("slices_cut.vert").unwrap();
    let module = load_words(&compile_unoptimised(&text, &[]).unwrap().words).unwrap();
    let shader = Types::of(&module).layout("SliceCut").unwrap();
    assert_eq!(differences(&slice_cut(), &shader), [""; 0]);
}

#[test]
fn tet_view_is_alike_in_rust_and_in_every_shader() {
    assert_alike("TetView", &tet_view(), "tet_enter.frag");
}

#[test]
fn bundle_is_alike_in_rust_and_in_every_shader() {
    assert_alike("Bundle", &bundle(), "structure/bundle.comp:LARGER");
}

#[test]
fn clip_plane_is_alike_in_rust_and_in_every_shader() {
    assert_alike("ClipPlane", &clip_plane(), "entry.frag:PLANES");
}

#[test]
fn single_rays_are_alike_in_rust_and_in_every_shader() {
    assert_alike("SingleRays", &single_rays(), "box.vert:SINGLE_RAYS");
}

#[test]
fn axis_piece_is_alike_in_rust_and_in_every_shader() {
    assert_alike("AxisPiece", &axis_piece(), "fused.frag:MARK_COPY+PREINTEGRATED");
}

#[test]
fn every_alteration_of_a_layout_is_seen() {
    for (name, rust) in
        [("Frame", frame()), ("Step", step()), ("Slice", slice()), ("Bundle", bundle()), ("AxisPiece", axis_piece())]
    {
        let shader = in_shaders(name).swap_remove(0).1;
        let altered = |alter: &dyn Fn(&mut Layout)| {
            let mut copy = rust.clone();
            alter(&mut copy);
            differences(&copy, &shader)
        };
        for at in 0..rust.members.len() {
            assert_eq!(altered(&|copy| copy.members[at].offset += 4).len(), 1, "{name}, offset of member {at}");
            assert_eq!(altered(&|copy| copy.members[at].bytes *= 2).len(), 1, "{name}, size of member {at}");
            assert_eq!(altered(&|copy| copy.members[at].name.push('s')).len(), 1, "{name}, name of member {at}");
        }
        assert_eq!(altered(&|copy| copy.members.swap(0, 1)).len(), 2, "{name}, two members swapped");
        assert!(!altered(&|copy| drop(copy.members.pop())).is_empty(), "{name}, the last member gone");
        assert_eq!(altered(&|copy| copy.bytes += 16).len(), 1, "{name}, its size");
    }
}
