//! Numbers as a reader wants them.

/// 1234567 as `1,234,567`.
pub fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let mut out = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Milliseconds to the hundredth: as fine as a median of frames means anything, and points stand below points.
pub fn milliseconds(ms: f64) -> String {
    format!("{ms:.2}")
}

/// A part of a whole as a percentage; `None` where the whole is 0.
pub fn percent(part: u64, whole: u64) -> Option<f64> {
    (whole > 0).then(|| 100.0 * part as f64 / whole as f64)
}

/// Bytes in the largest binary unit that leaves at least one.
pub fn bytes(count: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    let mut value = count as f64;
    let mut unit = "B";
    for larger in UNITS {
        if value < 1024.0 {
            break;
        }
        value /= 1024.0;
        unit = larger;
    }
    if unit == "B" { format!("{count} B") } else { format!("{value:.1} {unit}") }
}

/// `1.2e-3`, or `-` where there is no number.
pub fn error(value: Option<f64>) -> String {
    value.map_or("-".to_owned(), |e| if e == 0.0 { "0".to_owned() } else { format!("{e:.1e}") })
}
