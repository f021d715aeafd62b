//! What passes know rays by: where they meet the box, ENTRY and DIR, or where slices lie.

use super::constants;
use crate::feature::{self, SINGLE_RAYS};
use crate::part::Draw;
use crate::part::access::{Access, Usage};
use crate::part::rows::{Context, Hook};
use crate::resource;

/// Lets a draw find the ray of its pixel.
pub fn find(context: &Context, draw: &mut Draw, accesses: &mut Vec<Access>) {
    accesses.extend(context.method.stack().is_none().then(|| Usage::Sampled.of(resource::ENTRY)));
    find_length(context, draw, accesses);
}

/// Lets a draw of the box find where the ray of its pixel meets it.
pub fn meet(context: &Context, draw: &mut Draw, accesses: &mut Vec<Access>) {
    accesses.extend(feature::reads(context, Hook::Interval));
    draw.define(feature::defines(context, Hook::Interval));
    hand_on(context, draw, accesses);
}

/// Lets the vertex shader hand on rays in single floats, where a draw has such: it reads them, and not its fragments.
pub fn hand_on(context: &Context, draw: &mut Draw, accesses: &mut [Access]) {
    draw.vertex_define = SINGLE_RAYS.define(context);
    for access in accesses.iter_mut().filter(|access| access.resource == resource::SINGLE_RAYS) {
        access.usage = Usage::Placing;
    }
}

/// Lets a draw find how many samples the ray of its pixel takes.
pub fn find_length(context: &Context, draw: &mut Draw, accesses: &mut Vec<Access>) {
    if context.method.stack().is_none() {
        accesses.push(Usage::Sampled.of(resource::DIRECTION));
        return;
    }
    accesses.push(Usage::Sampled.of(resource::SLICES));
    accesses.extend(feature::reads(context, Hook::Interval));
    draw.define(["SLICES"]);
    draw.define(feature::defines(context, Hook::Interval));
    draw.specialize([constants::slice_surface(context)]);
}
