//! One axis of a squared distance transform after some of its rows have changed: only places are looked at again that a changed
//! row may reach.
//!
//! Along a column, the place that is nearest never goes back ([`super::axis`]). So the nearest of an anchor and of the next one
//! bound the nearest of all places between. These bounds are kept from one repair to the next, and say which places looked to a
//! row that has changed. Those that will look to one which has come nearer lie side by side with them, or with where they would
//! be: the squares of two ways differ by what rises along the column, so that a row which is the better of two here is the
//! better one all the way to where the nearest is on its other side.
//!
//! Where squares are too large to be told from each other the nearest is not known, so that places there are looked at again
//! wherever a row that has changed is as far.

use super::axis::{ANCHOR, Columns, LANES, Square, Towards, foot, least};

/// A place of some columns whose squares are others now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change<S> {
    pub place: usize,
    pub before: [S; LANES],
}

/// What was known of some columns, among rows of others.
#[derive(Clone, Copy)]
pub(super) struct Known<'a, S> {
    pub rows: &'a [[S; LANES]],
    /// Where the first place is.
    pub begin: usize,
    /// From there to the next one.
    pub stride: usize,
}

impl<'a, S> Known<'a, S> {
    #[inline]
    pub fn row(&self, place: usize) -> &'a [S; LANES] {
        &self.rows[self.begin + place * self.stride]
    }
}

/// What the nearest places of an anchor are between, in all lanes.
pub(super) type Bounds = [u32; 2];

/// The bounds that columns of some length have.
pub(super) fn anchors(length: usize) -> usize {
    length.div_ceil(ANCHOR)
}

/// One in so many rows: where more have changed, all are transformed anew, which then costs less.
const MANY: usize = 8;

/// Columns that are transformed anew in part.
pub(super) struct Repair<S> {
    pub columns: Columns<S>,
    /// What was transformed the last time.
    before: Vec<[S; LANES]>,
    /// Whether a place has been looked at again.
    pub stale: Vec<bool>,
    /// What the nearest of an anchor and of all places before the next one were between: rising from anchor to anchor.
    spans: Vec<[usize; 2]>,
    /// Whether all places are to be looked at.
    whole: bool,
}

impl<S: Square> Repair<S> {
    pub fn new(length: usize, weight: u32) -> Self {
        let (rows, anchors) = (vec![[S::FAR; LANES]; length], anchors(length));
        Self {
            columns: Columns::lasting(length, weight),
            before: rows,
            stale: vec![false; length],
            spans: vec![[0; 2]; anchors],
            whole: false,
        }
    }

    /// Takes the rows as they are now, and those of them that have changed, in their order; none where all may have.
    pub fn load(&mut self, rows: &[[S; LANES]], changes: Option<&[Change<S>]>) {
        self.columns.squares.copy_from_slice(rows);
        self.whole = changes.is_none_or(|changes| {
            self.before.copy_from_slice(rows);
            changes.iter().for_each(|change| self.before[change.place] = change.before);
            MANY * changes.len() > rows.len() || self.revives(changes)
        });
    }

    /// Whether anything has come into a lane that had nothing: its nearest were nowhere.
    fn revives(&self, changes: &[Change<S>]) -> bool {
        let came = |change: &Change<S>, lane: usize| {
            change.before[lane] == S::FAR && self.columns.squares[change.place][lane] < S::FAR
        };
        let mut lanes = (0..LANES).filter(|lane| changes.iter().any(|change| came(change, *lane)));
        lanes.any(|lane| self.before.iter().all(|row| row[lane] == S::FAR))
    }

    /// Transforms what has changed, for rays that go that way. `bounds` are of the last transform, and become this one's;
    /// `known` has for a place squares that were not less the last time.
    pub fn transform(
        &mut self,
        towards: Towards,
        bounds: &mut [Bounds],
        changes: Option<&[Change<S>]>,
        known: &Known<S>,
    ) {
        if let Some(changes) = changes.filter(|_| !self.whole) {
            for (of, bounds) in self.columns.bounds.iter_mut().zip(&*bounds) {
                *of = bounds.map(|place| place as usize);
            }
            self.columns.dilate(towards);
            self.mark(towards, changes, known);
            self.renew(towards);
        } else {
            self.columns.transform(towards);
            self.stale.fill(true);
        }
        for (bounds, of) in bounds.iter_mut().zip(&self.columns.bounds) {
            *bounds = of.map(|place| place as u32);
        }
    }

    /// Finds the places that changes may reach.
    fn mark(&mut self, towards: Towards, changes: &[Change<S>], known: &Known<S>) {
        self.stale.fill(false);
        let last = self.stale.len().saturating_sub(1);
        for anchor in 0..self.spans.len() {
            self.spans[anchor] = self.columns.between(anchor, last);
        }
        for anchor in 1..self.spans.len() {
            self.spans[anchor][1] = self.spans[anchor][1].max(self.spans[anchor - 1][1]);
        }
        for anchor in (1..self.spans.len()).rev() {
            self.spans[anchor - 1][0] = self.spans[anchor - 1][0].min(self.spans[anchor][0]);
        }
        let mut done = 0;
        for change in changes {
            let [begin, end] = towards.feet(change.place, last);
            (begin.max(done)..=end).for_each(|place| self.mark_from(towards, place, known));
            done = end + 1;
        }
    }

    /// Finds the places that a foot reaches now, or did before.
    fn mark_from(&mut self, towards: Towards, place: usize, known: &Known<S>) {
        let (before, after) = (foot(&self.before, place, towards), self.columns.feet[place]);
        if before == after {
            return;
        }
        // What comes nearer has to be less than what was known; what goes away was the nearest where it was equal.
        let (mut differs, mut nearest) = ([false; LANES], before);
        for lane in 0..LANES {
            differs[lane] = before[lane] != after[lane];
            nearest[lane] = before[lane].min(after[lane].next());
        }
        let ways = &self.columns.ways;
        let reaches = |there: usize| {
            let (way, known) = (ways[place.abs_diff(there)], known.row(there));
            let mut any = false;
            for lane in 0..LANES {
                any |= differs[lane] & (nearest[lane].plus(way).min(S::FAR) <= known[lane]);
            }
            any
        };
        let [first, last] = towards.from(place, self.stale.len() - 1);
        let from = self.spans.partition_point(|span| span[1] < place) * ANCHOR;
        let to = self.spans.partition_point(|span| span[0] <= place) * ANCHOR;
        let (from, to) = (from.clamp(first, last + 1), to.clamp(first, last + 1));
        for there in from..to {
            // Without a branch, so that rows are waited for side by side.
            self.stale[there] |= reaches(there);
        }
        for there in (first..from).rev().take_while(|there| reaches(*there)) {
            self.stale[there] = true;
        }
        for there in (to..=last).take_while(|there| reaches(*there)) {
            self.stale[there] = true;
        }
    }

    /// Looks at the places again that were found.
    fn renew(&mut self, towards: Towards) {
        let (anchors, last) = (self.spans.len(), self.stale.len().saturating_sub(1));
        let mut anchor = 0;
        while anchor < anchors {
            let run = (anchor..anchors).take_while(|anchor| self.stale[anchor * ANCHOR]).count();
            if run > 0 {
                let columns = &mut self.columns;
                let from = anchor.checked_sub(1).map_or(0, |before| columns.bounds[before][0]);
                let to = columns.bounds.get(anchor + run).map_or(last, |bounds| bounds[1]).max(from);
                let nearest = columns.feet[from..=to].iter().fold([S::FAR; LANES], least);
                columns.halve([anchor, anchor + run], [from, to], towards, &nearest);
            }
            anchor += run + 1;
        }
        for (place, _) in self.stale.iter().enumerate().filter(|(place, stale)| **stale && place % ANCHOR > 0) {
            let bounds = self.columns.between(place / ANCHOR, last);
            self.columns.look(place, towards.within(place, bounds));
        }
    }
}

impl Towards {
    /// The feet that the squares of a place are part of.
    fn feet(self, place: usize, last: usize) -> [usize; 2] {
        match self {
            Self::Either => [place.saturating_sub(1), last.min(place + 1)],
            Self::Up => [place.saturating_sub(1), place],
            Self::Down => [place, last.min(place + 1)],
        }
    }

    /// The places that rays come from to `place`.
    fn from(self, place: usize, last: usize) -> [usize; 2] {
        match self {
            Self::Either => [0, last],
            Self::Up => [0, place],
            Self::Down => [place, last],
        }
    }
}
