//! A hierarchy of boxes around items, for finding those that a ray may meet.

use glam::DVec3;

/// Items in a leaf at the most.
const LEAF: usize = 4;

/// Relative slack of boxes: rays are met in f64, a few roundings of which must not hide an item.
const SLACK: f64 = 1e-12;

/// An axis-aligned box: its least and its greatest corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub least: DVec3,
    pub greatest: DVec3,
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { least: DVec3::INFINITY, greatest: DVec3::NEG_INFINITY };

    /// The least box around points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { least: b.least.min(p), greatest: b.greatest.max(p) })
    }

    /// The least box around this one and another.
    pub fn with(self, other: Self) -> Self {
        Self { least: self.least.min(other.least), greatest: self.greatest.max(other.greatest) }
    }

    fn middle(self) -> DVec3 {
        0.5 * (self.least + self.greatest)
    }

    /// Whether `origin + t * direction` meets the box for any t from 0 on; `margin` widens it on all sides.
    fn meets(self, origin: DVec3, inverse: DVec3, margin: f64) -> bool {
        let slack = margin + SLACK * (self.least.abs().max(self.greatest.abs()) + origin.abs()).max_element();
        let a = (self.least - slack - origin) * inverse;
        let b = (self.greatest + slack - origin) * inverse;
        // Where a ray runs along a face, 0 * infinity says nothing: `min` and `max` pass over it.
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            enter = enter.max(a[axis].min(b[axis]));
            leave = leave.min(a[axis].max(b[axis]));
        }
        enter <= leave
    }
}

#[derive(Clone, Copy, Debug)]
enum Node {
    /// Items from one place to another.
    Leaf { first: u32, end: u32 },
    /// The node that follows, and this one.
    Inner { other: u32 },
}

/// Boxes around items, halved at the median of their middles along the longest axis.
#[derive(Clone, Debug, Default)]
pub struct Hierarchy {
    nodes: Vec<(Bounds, Node)>,
    /// Items in the order of leaves, and their boxes.
    order: Vec<u32>,
    boxes: Vec<Bounds>,
}

impl Hierarchy {
    /// Around items with these boxes.
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut made = Self { order: (0..boxes.len() as u32).collect(), ..Self::default() };
        if !boxes.is_empty() {
            made.split(boxes, 0, boxes.len());
        }
        made.boxes = made.order.iter().map(|item| boxes[*item as usize]).collect();
        made
    }

    fn split(&mut self, boxes: &[Bounds], first: usize, end: usize) {
        let items = &mut self.order[first..end];
        let bounds = items.iter().fold(Bounds::EMPTY, |b, i| b.with(boxes[*i as usize]));
        let here = self.nodes.len();
        self.nodes.push((bounds, Node::Leaf { first: first as u32, end: end as u32 }));
        if end - first <= LEAF {
            return;
        }
        let sides = (bounds.greatest - bounds.least).to_array();
        let axis = (0..3).max_by(|a, b| sides[*a].total_cmp(&sides[*b])).unwrap_or(0);
        let middle = (end - first) / 2;
        items.select_nth_unstable_by(middle, |a, b| {
            let at = |i: u32| boxes[i as usize].middle()[axis];
            at(*a).total_cmp(&at(*b))
        });
        self.split(boxes, first, first + middle);
        let other = self.nodes.len() as u32;
        self.nodes[here].1 = Node::Inner { other };
        self.split(boxes, first + middle, end);
    }

    /// The items whose boxes, wider by `margin`, `origin + t * direction` meets for any t from 0 on.
    pub fn met(&self, origin: DVec3, direction: DVec3, margin: f64) -> Vec<u32> {
        let inverse = direction.recip();
        let mut found = Vec::new();
        let mut waiting: Vec<u32> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(at) = waiting.pop() {
            let (bounds, node) = self.nodes[at as usize];
            if !bounds.meets(origin, inverse, margin) {
                continue;
            }
            match node {
                Node::Leaf { first, end } => {
                    let items = first as usize..end as usize;
                    let meets = |at: &usize| self.boxes[*at].meets(origin, inverse, margin);
                    found.extend(items.filter(meets).map(|at| self.order[at]));
                }
                Node::Inner { other } => waiting.extend([at + 1, other]),
            }
        }
        found
    }

    /// The box around all items.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, |(bounds, _)| *bounds)
    }
}
