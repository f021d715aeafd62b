//! The pieces of a transfer function say what the function says.

use depthleap::part::Work;
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::transfer::{Knot, TransferFunction};
use depthleap::scene::{Scene, Settings};
use depthleap::shared::{Piece, pieces, rows};

use crate::random::Random;

impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }
}

/// The specialization constants PIECES and SEARCH, as a main pass is given them.
fn constants(transfer: &TransferFunction) -> (usize, usize) {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:4".to_owned());
    let scene = Scene { transfer: transfer.clone(), ..read::scene(&settings).unwrap() };
    let plan = plan(&scene, None).unwrap();
    let Some(Work::Draw(draw)) = plan.steps.last().map(|step| &step.work) else { panic!("a main pass draws") };
    let value = |name: &str| draw.constants.iter().find(|(n, _)| *n == name).unwrap().1 as usize;
    (value("PIECES"), value("SEARCH"))
}

/// `classify` of `glsl/shared/transfer.glsl`, line by line, in f32.
fn classify(pieces: &[Piece], (count, search): (usize, usize), value: f32) -> [f32; 4] {
    let mut at = 0;
    let mut width = search;
    while width > 0 {
        if at + width < count && value >= pieces[at + width].begin {
            at += width;
        }
        width >>= 1;
    }
    let piece = &pieces[at];
    let weight = (value - piece.begin).max(0.0) * piece.inverse_length;
    std::array::from_fn(|c| weight.mul_add(piece.change[c], piece.rgba[c]))
}

/// Rounding of one f32 operation, relative.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

/// Knots on a raster of x that f32 holds exactly, so that both sides agree where a jump is; jumps abound.
fn random_transfer(random: &mut Random, knots: usize) -> TransferFunction {
    let mut places: Vec<f64> = (0..knots).map(|_| random.below(33) as f64 / 32.0).collect();
    places.sort_by(f64::total_cmp);
    let knot = |x: f64| Knot { x, color: [0.0; 3].map(|_: f64| random.next()), opacity: random.next() };
    TransferFunction::new("random", places.into_iter().map(knot).collect(), 1.0).unwrap()
}

#[test]
fn rows_hold_all_of_a_piece() {
    let grey = TransferFunction::preset("ramp", 1.0).unwrap().unwrap();
    let pieces = pieces(&grey);
    let (coloured, plain) = (rows(&pieces, false), rows(&pieces, true));
    assert_eq!((coloured.len(), plain.len()), (3 * pieces.len(), 2 * pieces.len()));
    for (i, piece) in pieces.iter().enumerate() {
        let place = [piece.begin, piece.inverse_length, piece.clear, piece.clear_change];
        assert_eq!(coloured[3 * i..3 * i + 3], [place, piece.rgba, piece.change]);
        // Green and blue are red again.
        let [g, a, dg, da] = plain[2 * i + 1];
        assert_eq!((plain[2 * i], [g, g, g, a], [dg, dg, dg, da]), (place, piece.rgba, piece.change));
    }
}

#[test]
fn pieces_say_what_the_transfer_function_says() {
    let mut random = Random(11);
    let mut jumps = 0;
    for knots in (1..=40).chain(64..=66) {
        let transfer = random_transfer(&mut random, knots);
        let (pieces, constants) = (pieces(&transfer), constants(&transfer));
        assert_eq!((pieces.len(), constants.0), (knots, knots));
        jumps += transfer.jumps().count();
        // Every knot and jump, just beside it, outside, and between.
        let near = transfer.knots().iter().map(|k| k.x as f32).flat_map(|x| [x, x.next_down(), x.next_up()]);
        let between = (0..400).map(|_| (1.4 * random.next() - 0.2) as f32);
        for x in near.chain(between).chain([f32::MIN, -1.0, 2.0, f32::MAX]) {
            let (found, expected) = (classify(&pieces, constants, x), transfer.evaluate(f64::from(x)));
            for c in 0..4 {
                // The weight has four roundings, the change two, the sum one; all numbers lie in [0, 1].
                let error = (f64::from(found[c]) - expected[c]).abs();
                assert!(error <= 8.0 * ROUNDING, "{knots} knots, component {c} at {x}: {found:?}, {expected:?}");
            }
        }
    }
    assert!(jumps > 100, "{jumps}");
}

#[test]
fn knots_nearer_than_f32_can_tell_are_a_jump() {
    let knot = |x: f64, opacity: f64| Knot { x, color: [0.5; 3], opacity };
    let knots = vec![knot(0.0, 0.0), knot(0.5, 0.25), knot(0.5 + 1e-12, 0.75), knot(1.0, 1.0)];
    let transfer = TransferFunction::new("near", knots, 1.0).unwrap();
    let (pieces, constants) = (pieces(&transfer), constants(&transfer));
    assert_eq!((pieces[1].inverse_length, pieces[1].change), (0.0, [0.0; 4]));
    assert_eq!(classify(&pieces, constants, 0.5)[3], 0.75, "the later one counts");
    assert!((classify(&pieces, constants, 0.5_f32.next_down())[3] - 0.25).abs() < 1e-6);
}

#[test]
fn last_piece_is_endless() {
    let last = *pieces(&TransferFunction::preset("linear", 1.0).unwrap().unwrap()).last().unwrap();
    assert_eq!((last.rgba, last.change, last.inverse_length), ([1.0; 4], [0.0; 4], 0.0));
}
