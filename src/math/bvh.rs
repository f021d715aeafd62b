//! A hierarchy of boxes around items, for finding those that a ray may meet, the one nearest to a point, and sums over those
//! far away.

use std::ops::Range;

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

    /// The square of a point's distance; 0 inside.
    pub fn squared_distance(self, point: DVec3) -> f64 {
        (self.least - point).max(point - self.greatest).max(DVec3::ZERO).length_squared()
    }

    /// The square of the distance of the point of the box that is farthest from a point.
    pub fn squared_reach(self, point: DVec3) -> f64 {
        (point - self.least).max(self.greatest - point).length_squared()
    }

    /// The point in its middle.
    pub fn middle(self) -> DVec3 {
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

    /// The items in the order of leaves, in which those of a node stand together. Their places in it are what follows speaks of.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The item nearest to a point, by its place, with the square of its distance; none where no item is nearer than the root of
    /// `limit`. `squared` gives the square of an item's distance by its place; what is not below its second argument is not
    /// looked at.
    pub fn nearest(&self, point: DVec3, limit: f64, squared: &impl Fn(usize, f64) -> f64) -> Option<(usize, f64)> {
        let mut best = (None, limit);
        if !self.nodes.is_empty() {
            self.nearer(0, point, squared, &mut best);
        }
        best.0.map(|place| (place, best.1))
    }

    fn nearer(&self, at: usize, point: DVec3, squared: &impl Fn(usize, f64) -> f64, best: &mut (Option<usize>, f64)) {
        match self.nodes[at].1 {
            Node::Leaf { first, end } => {
                for place in first as usize..end as usize {
                    if self.boxes[place].squared_distance(point) < best.1 {
                        let distance = squared(place, best.1);
                        if distance < best.1 {
                            *best = (Some(place), distance);
                        }
                    }
                }
            }
            Node::Inner { other } => {
                let mut children =
                    [at + 1, other as usize].map(|node| (node, self.nodes[node].0.squared_distance(point)));
                if children[1].1 < children[0].1 {
                    children.swap(0, 1);
                }
                for (node, distance) in children {
                    if distance < best.1 {
                        self.nearer(node, point, squared, best);
                    }
                }
            }
        }
    }

    /// Something of each node, in the order that [`Self::visit`] numbers nodes in: made by `leaf` of the places of a leaf's items,
    /// joined by `join` of what was made of a node's two parts; both are given the node's box.
    pub fn gathered<T: Copy>(
        &self,
        leaf: impl Fn(Bounds, Range<usize>) -> T,
        join: impl Fn(Bounds, T, T) -> T,
    ) -> Vec<T> {
        // The parts of a node stand behind it.
        let mut backwards: Vec<T> = Vec::with_capacity(self.nodes.len());
        for (at, (bounds, node)) in self.nodes.iter().enumerate().rev() {
            let of = |node: usize| backwards[self.nodes.len() - 1 - node];
            let made = match *node {
                Node::Leaf { first, end } => leaf(*bounds, first as usize..end as usize),
                Node::Inner { other } => join(*bounds, of(at + 1), of(other as usize)),
            };
            backwards.push(made);
        }
        backwards.reverse();
        backwards
    }

    /// Goes through the nodes from the root on. `opens` is asked of each, by its number and its box, whether its parts are gone
    /// through too; where it says so of a leaf, `leaf` is given the places of its items, and the box.
    /// `state` is handed through.
    pub fn visit<S>(
        &self,
        state: &mut S,
        opens: impl Fn(&mut S, usize, Bounds) -> bool,
        leaf: impl Fn(&mut S, Range<usize>, Bounds),
    ) {
        // As deep as the hierarchy: it halves its items, whose numbers have 32 bits.
        let mut waiting = [0; u32::BITS as usize + 1];
        let mut count = usize::from(!self.nodes.is_empty());
        while let Some(next) = count.checked_sub(1) {
            count = next;
            let at = waiting[next];
            let (bounds, node) = self.nodes[at];
            if !opens(state, at, bounds) {
                continue;
            }
            match node {
                Node::Leaf { first, end } => leaf(state, first as usize..end as usize, bounds),
                Node::Inner { other } => {
                    [waiting[count], waiting[count + 1]] = [other as usize, at + 1];
                    count += 2;
                }
            }
        }
    }

    /// The box around all items.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, |(bounds, _)| *bounds)
    }
}
