//! Values of options that are more than one word.

/// A finite number.
pub fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|n: &f64| n.is_finite());
    number.ok_or_else(|| format!("`{text}` is not a finite number"))
}

/// `1,2,3` as N finite numbers.
pub fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    list(text, |part| part.parse().ok().filter(|n: &f64| n.is_finite()), "not a finite number")
}

/// `256,256,128` as sizes of a volume.
pub fn counts(text: &str) -> Result<[usize; 3], String> {
    list(text, |part| part.parse().ok().filter(|n| *n > 0), "not a number of voxels of at least 1")
}

/// N entries with commas between; `no` says what an entry is not that `entry` does not take.
fn list<T, const N: usize>(text: &str, entry: impl Fn(&str) -> Option<T>, no: &str) -> Result<[T; N], String> {
    let one = |part: &str| entry(part.trim()).ok_or_else(|| format!("`{part}` is {no}"));
    let entries: Vec<T> = text.split(',').map(one).collect::<Result<_, _>>()?;
    entries.try_into().map_err(|e: Vec<T>| format!("{N} numbers are needed, and the number given is {}", e.len()))
}
