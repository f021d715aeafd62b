//! Bytes and text to typed voxels: as many as were promised, no voxel fewer. What follows them is left to the caller.

use std::io::{self, Read};

use crate::scene::volume::{VoxelType, Voxels, each_type};

/// What was wrong with the bytes of a volume.
#[derive(Debug)]
pub enum Fault {
    /// They end after so many.
    Short {
        bytes: u64,
    },
    /// There is no memory for them.
    Memory,
    Read(io::Error),
}

/// Bytes read at once; memory grows by what has been read, so a lying header takes at most this much.
const BLOCK: usize = 1 << 20;

/// No voxels of this type yet.
pub fn none(voxel_type: VoxelType) -> Voxels {
    match voxel_type {
        VoxelType::U8 => Voxels::U8(Vec::new()),
        VoxelType::I8 => Voxels::I8(Vec::new()),
        VoxelType::U16 => Voxels::U16(Vec::new()),
        VoxelType::I16 => Voxels::I16(Vec::new()),
        VoxelType::U32 => Voxels::U32(Vec::new()),
        VoxelType::I32 => Voxels::I32(Vec::new()),
        VoxelType::U64 => Voxels::U64(Vec::new()),
        VoxelType::I64 => Voxels::I64(Vec::new()),
        VoxelType::F32 => Voxels::F32(Vec::new()),
        VoxelType::F64 => Voxels::F64(Vec::new()),
    }
}

/// A type of voxels as bytes.
trait Number: Sized {
    fn append(values: &mut Vec<Self>, bytes: &[u8], big_endian: bool);
}

macro_rules! number {
    ($($type:ty),*) => {
        $(impl Number for $type {
            fn append(values: &mut Vec<Self>, bytes: &[u8], big_endian: bool) {
                let number = if big_endian { Self::from_be_bytes } else { Self::from_le_bytes };
                values.extend(bytes.as_chunks().0.iter().map(|bytes| number(*bytes)));
            }
        })*
    };
}
number!(u8, i8, u16, i16, u32, i32, u64, i64, f32, f64);

/// Reads `count` voxels more into `voxels`.
pub fn binary(stream: &mut dyn Read, voxels: &mut Voxels, count: usize, big_endian: bool) -> Result<(), Fault> {
    each_type!(voxels, values => numbers(stream, values, count, big_endian))
}

fn numbers<T: Number>(stream: &mut dyn Read, values: &mut Vec<T>, count: usize, big: bool) -> Result<(), Fault> {
    let (size, mut left) = (size_of::<T>(), count);
    let mut block = Vec::new();
    while left > 0 {
        let wanted = (BLOCK / size).min(left);
        block.clear();
        stream.take((wanted * size) as u64).read_to_end(&mut block).map_err(Fault::Read)?;
        if block.len() < wanted * size {
            return Err(Fault::Short { bytes: ((count - left) * size + block.len()) as u64 });
        }
        values.try_reserve(wanted).map_err(|_| Fault::Memory)?;
        T::append(values, &block, big);
        left -= wanted;
    }
    Ok(())
}

/// What was wrong with numbers written as text.
#[derive(Debug)]
pub enum TextFault {
    /// There are so many numbers.
    Count(usize),
    /// This one, counted from 0, is none of the type.
    Number(usize, String),
    Memory,
}

/// The numbers of a text: white space and commas stand between them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c.is_ascii_whitespace() || c == ',').filter(|word| !word.is_empty())
}

/// Reads `count` voxels more from `text` into `voxels`; gives how many words follow them. `text` is the whole of a file's
/// numbers, so memory is bounded by what was read.
pub fn text(text: &str, voxels: &mut Voxels, count: usize) -> Result<usize, TextFault> {
    each_type!(voxels, values => parsed(text, values, count))
}

fn parsed<T: std::str::FromStr>(text: &str, values: &mut Vec<T>, count: usize) -> Result<usize, TextFault> {
    let found = words(text).count();
    if found < count {
        return Err(TextFault::Count(found));
    }
    values.try_reserve(count).map_err(|_| TextFault::Memory)?;
    for (i, word) in words(text).take(count).enumerate() {
        values.push(word.parse().map_err(|_| TextFault::Number(i, word.chars().take(LONGEST_SHOWN).collect()))?);
    }
    Ok(found - count)
}

/// Characters of a wrong number that an error shows.
const LONGEST_SHOWN: usize = 40;

/// How many of the voxels an f64 cannot hold exactly: 64-bit integers beyond 2^53.
pub fn rounded(voxels: &Voxels) -> usize {
    match voxels {
        Voxels::U64(v) => v.iter().filter(|v| (**v as f64) as u128 != u128::from(**v)).count(),
        Voxels::I64(v) => v.iter().filter(|v| (**v as f64) as i128 != i128::from(**v)).count(),
        _ => 0,
    }
}
