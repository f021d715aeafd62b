//! Which edges of the lattice a level crosses, and the numbers of the vertices on them.

use rayon::prelude::*;

use super::cases::{CASES, CORNERS, edge};
use super::lattice::{BITS, Faces, Lattice, too_little_memory};
use crate::error::{Error, Result};
use crate::scene::Field;

/// The side of a level that each node is on, and how many vertices and triangles come before each word of nodes.
pub struct Crossings<'a> {
    pub lattice: Lattice,
    field: &'a Field,
    /// Of each row of nodes, its words: a bit where the value is not below the level.
    above: Vec<u64>,
    /// Of each word, the nodes with a vertex on the edge that goes up along x, y and z.
    vertices: Vec<[u64; 3]>,
    /// The vertices, and the triangles, before each word.
    before: Vec<[u32; 2]>,
    /// Vertices and triangles in all.
    pub count: [u32; 2],
}

/// A word of nodes: its row and its place in it.
#[derive(Clone, Copy)]
pub(super) struct Word {
    y: usize,
    z: usize,
    at: usize,
}

impl<'a> Crossings<'a> {
    /// # Errors
    /// When there are more vertices or triangles than 32 bits count, or there is not enough memory.
    pub fn new(field: &'a Field, level: f32, faces: Faces) -> Result<Self> {
        let lattice = Lattice::new(field, faces);
        let (vertices, before, count) = (Vec::new(), Vec::new(), [0; 2]);
        let above = lattice.above(field, level)?;
        let mut crossings = Self { lattice, field, above, vertices, before, count };
        crossings.vertices = crossings.of_words(Self::crossed)?;
        crossings.before = crossings.of_words(Self::counted)?;
        let mut sum = [0u64; 2];
        for one in &mut crossings.before {
            let here = one.map(u64::from);
            *one = sum.map(|sum| sum as u32);
            sum = [sum[0] + here[0], sum[1] + here[1]];
        }
        let most = sum[0].max(sum[1]);
        crossings.count = sum.map(|sum| sum as u32);
        if most > u64::from(u32::MAX) {
            let problem =
                format!("has a shell of {most} triangles or vertices at x = {level}, which 32 bits do not count");
            return Err(Error::input(&field.volume.name, problem, "choose another level"));
        }
        Ok(crossings)
    }

    /// Something of every word.
    fn of_words<T: Send>(&self, of: fn(&Self, Word) -> T) -> Result<Vec<T>> {
        let words = self.lattice.words();
        let mut all = Vec::new();
        let count = self.lattice.rows() * words;
        all.try_reserve_exact(count).map_err(|_| too_little_memory(self.field))?;
        let found = (0..count).into_par_iter().with_min_len(words).map(|i| of(self, self.word(i)));
        found.collect_into_vec(&mut all);
        Ok(all)
    }

    fn word(&self, i: usize) -> Word {
        let (row, at) = (i / self.lattice.words(), i % self.lattice.words());
        let rows = self.lattice.nodes()[1];
        Word { y: row % rows, z: row / rows, at }
    }

    fn index(&self, Word { y, z, at }: Word) -> usize {
        (z * self.lattice.nodes()[1] + y) * self.lattice.words() + at
    }

    /// The sides of the nodes of a word.
    fn sides(&self, word: Word) -> u64 {
        self.above[self.index(word)]
    }

    /// The sides of the nodes one further along x.
    fn next_sides(&self, word: Word) -> u64 {
        let further = Word { at: word.at + 1, ..word };
        let last = if further.at < self.lattice.words() { self.sides(further) << (BITS - 1) } else { 0 };
        self.sides(word) >> 1 | last
    }

    /// The nodes of a word that have a neighbour along x.
    fn with_next(&self, word: Word) -> u64 {
        let nodes = (self.lattice.nodes()[0] - 1).saturating_sub(word.at * BITS);
        if nodes >= BITS { u64::MAX } else { (1 << nodes) - 1 }
    }

    /// The nodes of a word with a vertex on the edge that goes up along x, y and z: the level crosses it, and not all cells around it are
    /// holes.
    fn crossed(&self, word: Word) -> [u64; 3] {
        let here = self.sides(word);
        let [_, rows, slabs] = self.lattice.nodes();
        let along_x = (here ^ self.next_sides(word)) & self.with_next(word);
        let along_y = if word.y + 1 < rows { here ^ self.sides(Word { y: word.y + 1, ..word }) } else { 0 };
        let along_z = if word.z + 1 < slabs { here ^ self.sides(Word { z: word.z + 1, ..word }) } else { 0 };
        let mut axes = [along_x, along_y, along_z];
        if self.field.holes.is_some() {
            for (axis, nodes) in axes.iter_mut().enumerate() {
                let mut left = *nodes;
                while left != 0 {
                    let bit = left.trailing_zeros() as usize;
                    left &= left - 1;
                    let node = [word.at * BITS + bit, word.y, word.z];
                    *nodes &= !(u64::from(self.is_amid_holes(node, axis)) << bit);
                }
            }
        }
        axes
    }

    /// Whether all cells around the edge that goes up from a node along an axis are holes.
    fn is_amid_holes(&self, node: [usize; 3], axis: usize) -> bool {
        let nodes = self.lattice.nodes();
        let [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
        // Those that end at the node along each of the other axes, and those that begin there, as far as there are any.
        let along =
            |axis: usize| (node[axis].saturating_sub(1)..=node[axis]).filter(move |cell| cell + 1 < nodes[axis]);
        along(b).all(|at_b| {
            along(c).all(|at_c| {
                let mut cell = node;
                (cell[b], cell[c]) = (at_b, at_c);
                self.is_hole(cell)
            })
        })
    }

    /// The rows of a word's cells: its own, and those further along y, along z and along both; none where the volume ends.
    fn rows_of_cells(&self, word: Word) -> Option<[Word; 4]> {
        let [_, rows, slabs] = self.lattice.nodes();
        let (y, z) = (word.y + 1, word.z + 1);
        (y < rows && z < slabs).then_some([word, Word { y, ..word }, Word { z, ..word }, Word { y, z, ..word }])
    }

    /// Calls `found` with each cell of a word that the level crosses: its place in the word and its case.
    fn cells(&self, word: Word, mut found: impl FnMut(usize, usize)) {
        let Some(rows) = self.rows_of_cells(word) else { return };
        let sides = rows.map(|row| [self.sides(row), self.next_sides(row)]);
        let any = sides.iter().flatten().fold(0, |any, sides| any | sides);
        let all = sides.iter().flatten().fold(u64::MAX, |all, sides| all & sides);
        let mut crossed = any & !all & self.with_next(word);
        while crossed != 0 {
            let bit = crossed.trailing_zeros() as usize;
            crossed &= crossed - 1;
            if self.is_hole([word.at * BITS + bit, word.y, word.z]) {
                continue;
            }
            let case = (0..CORNERS).map(|corner| (sides[corner >> 1][corner & 1] >> bit & 1) << corner).sum::<u64>();
            found(bit, case as usize);
        }
    }

    /// The vertices and the triangles before each slab of nodes along z, and those in all.
    pub(super) fn slabs(&self) -> Vec<[usize; 2]> {
        let [_, rows, slabs] = self.lattice.nodes();
        let first = (0..slabs).map(|z| self.before[z * rows * self.lattice.words()]);
        first.chain([self.count]).map(|count| count.map(|n| n as usize)).collect()
    }

    /// The words of a slab of nodes.
    pub(super) fn words_of(&self, z: usize) -> impl Iterator<Item = Word> + use<> {
        let (rows, words) = (self.lattice.nodes()[1], self.lattice.words());
        (0..rows * words).map(move |i| Word { y: i / words, z, at: i % words })
    }

    /// Calls `found` with each vertex of a word in the order of their numbers: its node and the axis of its edge.
    pub(super) fn each_vertex(&self, word: Word, mut found: impl FnMut([usize; 3], usize)) {
        let axes = self.vertices[self.index(word)];
        let mut any = axes[0] | axes[1] | axes[2];
        while any != 0 {
            let bit = any.trailing_zeros() as usize;
            any &= any - 1;
            let node = [word.at * BITS + bit, word.y, word.z];
            (0..3).filter(|axis| axes[*axis] >> bit & 1 == 1).for_each(|axis| found(node, axis));
        }
    }

    /// Calls `found` with each triangle of a word: the numbers of its vertices.
    pub(super) fn each_triangle(&self, word: Word, mut found: impl FnMut([u32; 3])) {
        self.cells(word, |bit, case| {
            for triangle in &CASES[case] {
                found(triangle.map(|number| {
                    let (axis, corner) = edge(number.into());
                    let x = bit + (corner & 1);
                    let at = word.at + x / BITS;
                    self.vertex(Word { y: word.y + (corner >> 1 & 1), z: word.z + (corner >> 2), at }, x % BITS, axis)
                }));
            }
        });
    }

    /// The number of the vertex on the edge of a node along an axis.
    fn vertex(&self, word: Word, bit: usize, axis: usize) -> u32 {
        let axes = self.vertices[self.index(word)];
        let nodes_before = (1 << bit) - 1;
        let before = axes.iter().map(|along| (along & nodes_before).count_ones()).sum::<u32>();
        let here = axes[..axis].iter().map(|along| (along >> bit & 1) as u32).sum::<u32>();
        self.before[self.index(word)][0] + before + here
    }

    /// Whether the cell that goes up from a node is a hole.
    fn is_hole(&self, node: [usize; 3]) -> bool {
        let Some(holes) = &self.field.holes else { return false };
        let cells = self.field.cells();
        let [x, y, z] = std::array::from_fn(|axis| self.lattice.voxel(axis, node[axis]).min(cells[axis] - 1));
        holes[(z * cells[1] + y) * cells[0] + x]
    }

    /// Vertices and triangles of a word.
    fn counted(&self, word: Word) -> [u32; 2] {
        let vertices = self.vertices[self.index(word)].map(u64::count_ones).iter().sum();
        let mut triangles = 0;
        self.cells(word, |_, case| triangles += CASES[case].len() as u32);
        [vertices, triangles]
    }
}
