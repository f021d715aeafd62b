//! How files are damaged.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

/// What numbers are changed into.
const ODD: [&str; 24] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e-320",
    "1e-30",
    "1e-4",
    "1e4",
    "1e30",
    "1e308",
    "-1e308",
    "1e999",
    "nan",
    "inf",
    "-inf",
    "65535",
    "65536",
    "4294967296",
    "9223372036854775807",
    "18446744073709551616",
    "[]",
    "\"\"",
];

/// Numbers below a bound, the same in every run.
pub struct Numbers(u64);

impl Numbers {
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    pub fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}

/// In memory where the system has such a place: very many small files go through it.
pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap()
}

/// Parts of the work, each with a folder and numbers of its own, whatever the number of threads.
const PARTS: usize = 50;

/// Makes `count` inputs, on all cores, each by `one` in a folder that `prepare` filled; gives how many were read.
pub fn each(
    seed: u64,
    count: usize,
    prepare: impl Fn(&Path) + Sync,
    one: impl Fn(&Path, &mut Numbers) -> bool + Sync,
) -> usize {
    let read = AtomicUsize::new(0);
    (0..PARTS).into_par_iter().for_each(|part| {
        let (folder, mut numbers) = (folder(), Numbers(seed << 32 | part as u64));
        // The first numbers of seeds that are near each other are near each other too.
        for _ in 0..8 {
            numbers.below(2);
        }
        prepare(folder.path());
        for _ in 0..count / PARTS {
            read.fetch_add(usize::from(one(folder.path(), &mut numbers)), Ordering::Relaxed);
        }
    });
    read.into_inner()
}

/// What no line of a header or a scene should hold.
const JUNK: [&[u8]; 6] = [b"\x1b[2J", b"\xff\xfe", b"\0", b": ", b":=", "\u{202e}\u{85}".as_bytes()];

/// `text` with one to three changes: a number made odd, or bytes changed, left out, doubled, cut off or put in.
pub fn damaged(text: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..=numbers.below(3) {
        let at = numbers.below(text.len().max(1)).min(text.len());
        let end = (at + 1 + numbers.below(8)).min(text.len());
        match numbers.below(10) {
            0 => text.iter_mut().skip(at).take(1).for_each(|b| *b = numbers.below(256) as u8),
            1 => drop(text.drain(at..end)),
            2 => {
                let part = text[at..end].to_vec();
                text.splice(at..at, part);
            }
            3 => text.truncate(at),
            4 => drop(text.splice(at..at, numbers.pick(&JUNK).iter().copied())),
            5 if numbers.below(8) == 0 => {
                let long = vec![*numbers.pick(b"x9 \x07\xe4\n"); 3000];
                drop(text.splice(at..at, long));
            }
            _ => {
                let digit = |b: &u8| b.is_ascii_digit() || *b == b'.';
                let Some(begin) = text[at..].iter().position(digit).map(|i| at + i) else { continue };
                let length = text[begin..].iter().take_while(|b| digit(b)).count();
                text.splice(begin..begin + length, numbers.pick(&ODD).bytes());
            }
        }
    }
    text
}
