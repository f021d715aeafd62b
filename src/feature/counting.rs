//! Counting the rays that are left, so that passes nobody takes part in are not run [after Thesis §5.3.3].

use super::decisions::DECISIONS;
use crate::part::rows::{Context, Feature, Why};

/// Every so many main passes the rays that are left are counted.
pub const BATCH: u32 = 8;

/// Counts of the rays that are left.
pub const COUNTING: Feature = Feature::of_frame("counting of rays", needed);

fn needed(context: &Context) -> Result<(), Why> {
    if context.form.is_none() {
        return Err(Why::Untold);
    }
    if !context.has(&DECISIONS) {
        return Err("no ray is marked".into());
    }
    if context.passes <= BATCH {
        return Err(format!("there are no more than {BATCH} main passes").into());
    }
    Ok(())
}
