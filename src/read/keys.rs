//! What serde says of a wrong key or name, told with the nearest known one. The keys are said once, by the structs.

use crate::scene::builtin::nearest;

/// A user knows no `u32`.
const COUNT: &str = "expected a whole number from 0 on";

/// What serde calls a type, and what a user does.
const TYPES: [(&str, &str); 5] = [
    ("expected f64", "expected a number"),
    ("expected u32", COUNT),
    ("expected usize", COUNT),
    ("expected i64", "expected a whole number"),
    ("expected a sequence", "expected a list"),
];

/// Problem and remedy in a deserializer's message: ``unknown field `x`, expected one of `a`, `b` `` becomes
/// "unknown key `x`" and "did you mean `a`? known are `a`, `b`"; other messages stay as they are.
pub fn explain(message: &str) -> (String, String) {
    let message = message.trim().replace('\n', ", ");
    for (said, kind) in [("unknown field ", "key"), ("unknown variant ", "name")] {
        let Some(rest) = message.strip_prefix(said) else { continue };
        let mut quoted = rest.split('`').skip(1).step_by(2);
        let wrong = quoted.next().unwrap_or_default();
        let known: Vec<&str> = quoted.collect();
        let near = nearest(wrong, known.iter().copied()).map_or(String::new(), |n| format!("did you mean `{n}`? "));
        return (format!("has the unknown {kind} `{wrong}`"), format!("{near}known are {}", known.join(", ")));
    }
    let message = TYPES.iter().fold(message, |text, (said, meant)| text.replace(said, meant));
    (format!("is wrong: {message}"), "correct it".into())
}
