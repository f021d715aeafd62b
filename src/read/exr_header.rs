//! What the head of an OpenEXR file promises, before a decoder takes memory for it.

/// Bytes of the list of channels at the most, some 200 channels: a decoder takes memory for all of them.
const MOST_OF_CHANNELS: usize = 4096;

/// The flags, behind magic number and version, of a file with several parts and of one whose texels have any number of samples.
const SEVERAL_PARTS: u8 = 0x10;
const DEEP: u8 = 0x08;

/// Whether the windows of a file are within so many texels across and down, and its other sizes within reason.
///
/// # Errors
/// What is wrong with it.
pub fn check(bytes: &[u8], most: [u32; 2]) -> Result<(), String> {
    let cut_off = || "is cut off in its header".to_owned();
    let (flags, mut rest) = (bytes.get(5).ok_or_else(cut_off)?, bytes.get(8..).ok_or_else(cut_off)?);
    if flags & (SEVERAL_PARTS | DEEP) != 0 {
        return Err("has several parts, or several samples in a texel".to_owned());
    }
    // Attributes: a name and a type, each up to a byte 0, the size of the value, the value. The last name is empty.
    let mut windows = 0;
    loop {
        let name = text(&mut rest).ok_or_else(cut_off)?;
        if name.is_empty() {
            let whole = windows == 2;
            return whole.then_some(()).ok_or_else(|| "does not say the sizes of its two windows once".to_owned());
        }
        let _type = text(&mut rest).ok_or_else(cut_off)?;
        let size = number(take(&mut rest, 4).ok_or_else(cut_off)?);
        let value = usize::try_from(size).ok().and_then(|size| take(&mut rest, size)).ok_or_else(cut_off)?;
        match name {
            b"dataWindow" | b"displayWindow" => {
                windows += 1;
                let sides = sides(value).ok_or_else(|| "has a window without corners".to_owned())?;
                if (0..2).any(|axis| !(1..=i64::from(most[axis])).contains(&sides[axis])) {
                    return Err(format!("has {} x {} texels", sides[0], sides[1]));
                }
            }
            b"tiles" => {
                let sides: Vec<i64> = value.chunks_exact(4).take(2).map(number).collect();
                if sides.len() < 2 || sides.iter().zip(most).any(|(side, most)| !(1..=i64::from(most)).contains(side)) {
                    return Err(format!("has tiles of {sides:?} texels"));
                }
            }
            b"channels" if value.len() > MOST_OF_CHANNELS => {
                return Err(format!("has a list of channels of {} bytes", value.len()));
            }
            _ => {}
        }
    }
}

/// Takes so many bytes off.
fn take<'a>(rest: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (taken, left) = rest.split_at_checked(count)?;
    *rest = left;
    Some(taken)
}

/// Takes what stands in front of a byte 0 off, and that.
fn text<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    let end = rest.iter().position(|byte| *byte == 0)?;
    take(rest, end + 1).map(|taken| &taken[..end])
}

fn number(bytes: &[u8]) -> i64 {
    let mut four = [0; 4];
    four.copy_from_slice(&bytes[..4]);
    i32::from_le_bytes(four).into()
}

/// Texels across and down, of the first and the last column and row.
fn sides(value: &[u8]) -> Option<[i64; 2]> {
    if value.len() != 16 {
        return None;
    }
    let [left, top, right, bottom] = [0, 4, 8, 12].map(|at| number(&value[at..]));
    Some([right - left + 1, bottom - top + 1])
}
