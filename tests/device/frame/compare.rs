//! A frame of a device held against its f64 twin, and against other frames that have to be the same.

use depthleap::frame::{Counts, CpuFrame};

use super::scenes::{Shot, differing};

/// Largest difference between a frame in f32 and the same in f64: some hundred rounded samples.
pub const SAME_SUM: f64 = 2e-5;

/// The largest difference over decided pixels, beyond what the twin states of each, or where it is more than rounding explains.
pub fn difference(picture: &[[f32; 4]], twin: &CpuFrame, rounding: f64) -> Result<f64, String> {
    let mut largest = 0.0f64;
    let mut worst = String::new();
    for (i, (found, rule)) in picture.iter().zip(&twin.pixels).enumerate().filter(|(i, _)| !twin.undecided[*i]) {
        let apart = (0..4).map(|c| (f64::from(found[c]) - rule[c]).abs()).fold(0.0, f64::max);
        let off = (apart - twin.rounding[i]).max(0.0);
        if off > largest || apart.is_nan() {
            largest = off;
            worst = format!("pixel {i} is {found:?}, its twin {rule:?}");
        }
    }
    if largest <= rounding { Ok(largest) } else { Err(format!("{largest:e} apart: {worst}")) }
}

/// Whether a frame is its twin's: picture as [`difference`], counts but for the rays that f32 cannot decide. The twin
/// interpolates in f64; `stated` is what the plan states where a texture unit does, else 0.
pub fn held(shot: &Shot, twin: &CpuFrame, stated: f64) -> Result<f64, String> {
    held_unless(shot, twin, stated, |_, _, _| false)
}

/// As [`held`], of frames whose updates look at every pixel as long as any ray is left, which may be one whose cells are undecided: such a
/// ray may keep them going for `batch` passes more than its twin does, where its driver sees an edge on another side.
pub fn held_in_batches(shot: &Shot, twin: &CpuFrame, stated: f64, batch: usize) -> Result<f64, String> {
    let updates = &twin.counts.intermediate;
    let all = updates.iter().copied().max().unwrap_or(0);
    let end = updates.iter().rposition(|count| *count > 0).map_or(0, |last| last + 1);
    held_unless(shot, twin, stated, |kind, pass, found| {
        kind == "intermediate" && found == all && (end..end + batch).contains(&pass)
    })
}

/// As [`held`], but that a pass of a kind may have the count for which `may` says so where pixels are undecided.
fn held_unless(
    shot: &Shot,
    twin: &CpuFrame,
    stated: f64,
    may: impl Fn(&str, usize, u64) -> bool,
) -> Result<f64, String> {
    let largest = difference(&shot.picture, twin, SAME_SUM + stated)?;
    let undecided = twin.undecided.iter().filter(|u| **u).count() as u64;
    let counts = counts(shot);
    let of_kinds =
        [("main", &counts.main, &twin.counts.main), ("intermediate", &counts.intermediate, &twin.counts.intermediate)];
    for (kind, found, rule) in of_kinds {
        if found.len() != rule.len() {
            return Err(format!("{} {kind} passes where the twin has {}", found.len(), rule.len()));
        }
        for (pass, (found, rule)) in found.iter().zip(rule).enumerate() {
            if found.abs_diff(*rule) > undecided && !(undecided > 0 && may(kind, pass, *found)) {
                let has = format!("{kind} pass {pass} has {found} fragments, its twin {rule}");
                return Err(format!("{has}, {undecided} are undecided"));
            }
        }
    }
    if counts.light.abs_diff(twin.counts.light) > undecided {
        let (found, rule) = (counts.light, twin.counts.light);
        return Err(format!("{found} rays are lit, of its twin {rule}, and {undecided} are undecided"));
    }
    Ok(largest)
}

/// Whether a picture is another one, bit for bit.
pub fn same_picture(found: &[[f32; 4]], rule: &[[f32; 4]]) -> Result<(), String> {
    match differing(found, rule) {
        0 => Ok(()),
        differs => Err(format!("{differs} pixels differ")),
    }
}

/// Whether the fragments are those of another form.
pub fn same_counts(found: &Counts, rule: &Counts) -> Result<(), String> {
    if found == rule { Ok(()) } else { Err(format!("{found:?} fragments where the first form has {rule:?}")) }
}

/// The fragments of a frame that was counted.
pub fn counts(shot: &Shot) -> &Counts {
    shot.run.fragments.as_ref().expect("counts")
}
