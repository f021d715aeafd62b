//! Every projection of voxels that are negative, missing, or far beyond the range.

use super::super::case::{Expect, StabilityCase, Tolerance};
use super::values::{doubles, pattern};
use crate::projection::PROJECTIONS;
use crate::scene::field::NanPolicy;
use crate::scene::settings::Offset;

const GROUP: &str = "projection";

/// Values that a thousand steps sum up.
const SUM: Tolerance =
    Tolerance { absolute: 2e-5, relative: 5e-5, reason: "the same samples, rounded to f32 and summed up in it" };

pub fn cases() -> Vec<StabilityCase> {
    let mut cases = Vec::new();
    for row in PROJECTIONS {
        let mut case = |what: &str, value: &dyn Fn(usize) -> f64, change: &dyn Fn(&mut StabilityCase)| {
            cases.extend(doubles(value).map(|volume| {
                let name = format!("{}, {what}", row.name);
                let mut case = StabilityCase::new(GROUP, name, "").preset("linear").voxels(volume);
                case.settings.projection.kind = row.name();
                case.settings.volume.range = Some([0.0, 1.0].map(Into::into));
                change(&mut case);
                case.expect(Expect::Sum, SUM)
            }));
        };
        case("nothing but negative values", &|i| pattern(i) - 1.5, &|_| {});
        case("values of a thousand ranges", &|i| 1e3 * pattern(i), &|case| {
            case.settings.sampling.offset = Offset::Midpoint;
        });
        case("holes", &|i| if i % 31 == 3 { f64::NAN } else { pattern(i) - 0.3 }, &|case| {
            case.settings.volume.nan = NanPolicy::Hole;
        });
    }
    cases
}
