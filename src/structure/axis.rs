//! One axis of a squared distance transform, for [`LANES`] columns side by side: the square of each place becomes the
//! least, over all places, of the square there and that of the way there.
//!
//! Going along a column, the nearest place never goes back: squares of ways are convex, so that of two places the further
//! one, once it is the better, stays the better. What is nearest to both ends of a stretch therefore bounds what is
//! nearest to all between. Every eighth place is settled first, by halving stretches (divide and conquer as for
//! totally monotone matrices, Aggarwal et al., Geometric Applications of a Matrix-Searching Algorithm, 1987), within
//! bounds that serve all lanes; then those between, which look at what is left. So everything is plain arithmetic on lanes.

use super::square::{FAR_SQUARED, reach, square_of};

/// Columns that are transformed side by side.
pub const LANES: usize = 16;

/// Places from one that is settled by halving to the next.
pub(super) const ANCHOR: usize = 8;

/// A squared distance in some unit.
pub trait Square: Copy + Ord + Send + Sync + 'static {
    /// All that is no nearer is one and the same.
    const FAR: Self;
    /// The square of a way of `count` cells, whose sides have that square.
    fn of_way(count: usize, weight: u32) -> Self;
    /// The sum; [`Square::FAR`] or more where it is far.
    fn plus(self, way: Self) -> Self;
    /// The next larger one, but none that is larger than [`Square::FAR`].
    fn next(self) -> Self;
    /// The number of a place in a column, as wide as squares are, so that lanes hold as many of both.
    fn of_place(place: usize) -> Self;
    fn place(self) -> usize;
}

/// In squared sides of cells that are cubes, so that `weight` is 1: distances that are told apart are less than 255 voxels.
/// Columns have no more places than it has numbers.
impl Square for u16 {
    const FAR: Self = Self::MAX;

    fn of_way(count: usize, weight: u32) -> Self {
        let square = count.saturating_mul(count).saturating_mul(weight as usize);
        square.try_into().unwrap_or(Self::FAR)
    }

    #[inline]
    fn plus(self, way: Self) -> Self {
        self.saturating_add(way)
    }

    #[inline]
    fn next(self) -> Self {
        self.saturating_add(1)
    }

    fn of_place(place: usize) -> Self {
        place as Self
    }

    fn place(self) -> usize {
        self.into()
    }
}

/// In the unit of [`super::square`].
impl Square for u32 {
    const FAR: Self = FAR_SQUARED;

    fn of_way(count: usize, weight: u32) -> Self {
        square_of(count.try_into().unwrap_or(Self::MAX), weight, reach(weight))
    }

    #[inline]
    fn plus(self, way: Self) -> Self {
        // Each is 2^29 at the most.
        self + way
    }

    #[inline]
    fn next(self) -> Self {
        Self::FAR.min(self + 1)
    }

    fn of_place(place: usize) -> Self {
        place as Self
    }

    fn place(self) -> usize {
        self as usize
    }
}

/// Which way rays may go along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Towards {
    Either,
    Up,
    Down,
}

impl Towards {
    /// Both ways along an axis, the way of octants whose bit is 0 first.
    pub const WAYS: [Self; 2] = [Self::Up, Self::Down];

    /// The places that rays from `place` come to, of those from the first to the last.
    pub(super) fn within(self, place: usize, [first, last]: [usize; 2]) -> [usize; 2] {
        match self {
            Self::Either => [first, last],
            Self::Up => [first.max(place), last],
            Self::Down => [first, last.min(place)],
        }
    }

    /// The same places and all before them that rays from `place` come to: where they come to nothing near now, what comes near
    /// later may be the nearest of places that rays pass before.
    fn with(self, place: usize, [first, last]: [usize; 2]) -> [usize; 2] {
        match self {
            Self::Either => [first, last],
            Self::Up => [first, last.max(place)],
            Self::Down => [first.min(place), last],
        }
    }
}

/// Squares of ways of up to `length` cells, by their number.
pub fn ways<S: Square>(length: usize, weight: u32) -> Vec<S> {
    (0..length).map(|count| S::of_way(count, weight)).collect()
}

/// Squared box distance to the nearest flag of a row that rays may come to.
pub fn first_axis<S: Square>(ways: &[S], towards: Towards, flags: &[bool], squares: &mut [S]) {
    squares.fill(S::FAR);
    // Between boxes, so that a neighbour is as near as the cell itself.
    let apart = |from: usize, to: usize| ways[from.abs_diff(to).saturating_sub(1)];
    let mut before: Option<usize> = None;
    let mut place = 0;
    while let Some(next) = flags[place..].iter().position(|flag| *flag).map(|ahead| place + ahead) {
        let begin = before.map_or(0, |flag| flag + 1);
        for (i, square) in (begin..next).zip(&mut squares[begin..next]) {
            let up = if towards == Towards::Down { S::FAR } else { apart(i, next) };
            let down = before.filter(|_| towards != Towards::Up).map_or(S::FAR, |flag| apart(i, flag));
            *square = up.min(down);
        }
        squares[next] = ways[0];
        (before, place) = (Some(next), next + 1);
    }
    if let Some(flag) = before.filter(|_| towards != Towards::Up) {
        (flag + 1..).zip(&mut squares[flag + 1..]).for_each(|(i, square)| *square = apart(i, flag));
    }
}

/// Columns of one length.
pub struct Columns<S> {
    pub(super) ways: Vec<S>,
    /// What is to be transformed.
    pub(super) squares: Vec<[S; LANES]>,
    /// What has become of it.
    pub least: Vec<[S; LANES]>,
    /// The [`foot`] of each place.
    pub(super) feet: Vec<[S; LANES]>,
    /// Between which places all nearest ones of an anchor are.
    pub(super) bounds: Vec<[usize; 2]>,
    /// Whether these are to hold for squares that become less, too.
    lasting: bool,
}

impl<S: Square> Columns<S> {
    pub fn new(length: usize, weight: u32) -> Self {
        let rows = vec![[S::FAR; LANES]; length];
        let bounds = vec![[0; 2]; length.div_ceil(ANCHOR)];
        let (squares, least) = (rows.clone(), rows.clone());
        Self { ways: ways(length, weight), squares, least, feet: rows, bounds, lasting: false }
    }

    /// Columns whose bounds go on holding where squares change, which takes longer to find them.
    pub(super) fn lasting(length: usize, weight: u32) -> Self {
        Self { lasting: true, ..Self::new(length, weight) }
    }

    /// Takes the rows of a column each, of [`LANES`] squares or fewer.
    pub fn load<'a>(&mut self, row: impl Fn(usize) -> &'a [S]) {
        for (place, squares) in self.squares.iter_mut().enumerate() {
            take(squares, row(place));
        }
    }

    /// Takes a row of several columns side by side.
    pub fn load_row(tile: &mut [Self], place: usize, row: &[S]) {
        let mut parts = row.chunks(LANES);
        tile.iter_mut().for_each(|columns| take(&mut columns.squares[place], parts.next().unwrap_or_default()));
    }

    /// Puts what has become of it into a slab whose rows have `length` elements, from `begin` on.
    pub fn store(&self, slab: &mut [S], length: usize, begin: usize, width: usize) {
        for (row, least) in slab.chunks_exact_mut(length).zip(&self.least) {
            match row[begin..][..width].first_chunk_mut() {
                Some(whole) => *whole = *least,
                None => row[begin..][..width].copy_from_slice(&least[..width]),
            }
        }
    }

    /// Transforms all lanes, for rays that go that way.
    pub fn transform(&mut self, towards: Towards) {
        self.dilate(towards);
        let near = |row: &[S; LANES]| row.iter().any(|foot| *foot < S::FAR);
        let ends = [self.feet.iter().position(near), self.feet.iter().rposition(near)];
        let [Some(first), Some(last)] = ends else {
            self.least.fill([S::FAR; LANES]);
            return;
        };
        let mut nearest = [S::FAR; LANES];
        self.feet.iter().for_each(|row| nearest = least(nearest, row));
        let anchors = self.bounds.len();
        self.halve([0, anchors], [first, last], towards, &nearest);
        for anchor in 0..anchors {
            let bounds = self.between(anchor, last);
            for place in anchor * ANCHOR + 1..((anchor + 1) * ANCHOR).min(self.least.len()) {
                self.look(place, towards.within(place, bounds));
            }
        }
    }

    pub(super) fn dilate(&mut self, towards: Towards) {
        for (place, to) in self.feet.iter_mut().enumerate() {
            *to = foot(&self.squares, place, towards);
        }
    }

    /// Between which places all nearest ones are of an anchor and of the places from it to the next, which is settled too. None
    /// is beyond `last`.
    pub(super) fn between(&self, anchor: usize, last: usize) -> [usize; 2] {
        [self.bounds[anchor][0], self.bounds.get(anchor + 1).map_or(last, |bounds| bounds[1])]
    }

    /// Settles the anchors from the first to one before the second, whose nearest places are within `bounds`.
    pub(super) fn halve(
        &mut self,
        [begin, end]: [usize; 2],
        [from, to]: [usize; 2],
        towards: Towards,
        nearest: &[S; LANES],
    ) {
        if begin < end {
            let middle = begin.midpoint(end);
            self.settle(middle, [from, to], towards, nearest);
            let [least, most] = self.bounds[middle];
            self.halve([begin, middle], [from, most], towards, nearest);
            self.halve([middle + 1, end], [least, to], towards, nearest);
        }
    }

    /// Finds the least of a place that is no anchor.
    pub(super) fn look(&mut self, place: usize, [first, last]: [usize; 2]) {
        let mut best = [S::FAR; LANES];
        for there in first..=last {
            let (way, feet) = (self.ways[place.abs_diff(there)], &self.feet[there]);
            for lane in 0..LANES {
                best[lane] = best[lane].min(feet[lane].plus(way));
            }
        }
        self.least[place] = best;
    }

    /// Finds the least of an anchor, and between which places it is in all lanes. Lanes in which nothing is near have no say;
    /// others in which it is too far to be told keep the bounds.
    fn settle(&mut self, anchor: usize, bounds: [usize; 2], towards: Towards, nearest: &[S; LANES]) {
        let place = anchor * ANCHOR;
        let [first, last] = towards.within(place, bounds);
        let mut best = [S::FAR; LANES];
        let mut at = [S::of_place(0); LANES];
        for there in first..=last {
            let (way, feet) = (self.ways[place.abs_diff(there)], &self.feet[there]);
            let number = S::of_place(there);
            for lane in 0..LANES {
                let square = feet[lane].plus(way);
                at[lane] = if square < best[lane] { number } else { at[lane] };
                best[lane] = best[lane].min(square);
            }
        }
        self.least[place] = best;
        let bounds = if self.lasting { towards.with(place, bounds) } else { bounds };
        let mut found = [usize::MAX, 0];
        for lane in (0..LANES).filter(|lane| nearest[*lane] < S::FAR) {
            let at = at[lane].place();
            let of_lane = if best[lane] < S::FAR { [at, at] } else { bounds };
            found = [found[0].min(of_lane[0]), found[1].max(of_lane[1])];
        }
        self.bounds[anchor] = if found[0] <= found[1] { found } else { bounds };
    }
}

/// The squares of a place, or those of the neighbour that rays go away from where these are less: ways are counted between
/// boxes.
#[inline]
pub(super) fn foot<S: Square>(squares: &[[S; LANES]], place: usize, towards: Towards) -> [S; LANES] {
    let mut foot = squares[place];
    if towards != Towards::Down && place + 1 < squares.len() {
        foot = least(foot, &squares[place + 1]);
    }
    if towards != Towards::Up && place > 0 {
        foot = least(foot, &squares[place - 1]);
    }
    foot
}

fn take<S: Square>(squares: &mut [S; LANES], row: &[S]) {
    match row.try_into() {
        Ok(whole) => *squares = whole,
        Err(_) => {
            squares.fill(S::FAR);
            squares[..row.len()].copy_from_slice(row);
        }
    }
}

#[inline]
pub(super) fn least<S: Square>(mut a: [S; LANES], b: &[S; LANES]) -> [S; LANES] {
    for lane in 0..LANES {
        a[lane] = a[lane].min(b[lane]);
    }
    a
}
