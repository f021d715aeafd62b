//! Bytes to typed voxels: as many as were promised, no byte fewer, none more.

use std::io::{self, Read};

use crate::scene::volume::{VoxelType, Voxels};

/// What was wrong with the bytes of a volume.
#[derive(Debug)]
pub enum Fault {
    /// They end after so many.
    Short {
        bytes: u64,
    },
    /// They go on after the last voxel.
    Long,
    /// There is no memory for them.
    Memory,
    Read(io::Error),
}

/// Bytes read at once; memory grows by what has been read, so a lying header takes at most this much.
const BLOCK: usize = 1 << 20;

/// Reads `count` voxels and the end of the stream.
pub fn binary(stream: &mut dyn Read, voxel_type: VoxelType, count: usize, big_endian: bool) -> Result<Voxels, Fault> {
    macro_rules! typed {
        ($variant:ident, $type:ty) => {
            Voxels::$variant(numbers(
                stream,
                count,
                if big_endian { <$type>::from_be_bytes } else { <$type>::from_le_bytes },
            )?)
        };
    }
    Ok(match voxel_type {
        VoxelType::U8 => typed!(U8, u8),
        VoxelType::I8 => typed!(I8, i8),
        VoxelType::U16 => typed!(U16, u16),
        VoxelType::I16 => typed!(I16, i16),
        VoxelType::U32 => typed!(U32, u32),
        VoxelType::I32 => typed!(I32, i32),
        VoxelType::F32 => typed!(F32, f32),
        VoxelType::F64 => typed!(F64, f64),
    })
}

fn numbers<T, const N: usize>(stream: &mut dyn Read, count: usize, number: fn([u8; N]) -> T) -> Result<Vec<T>, Fault> {
    let mut values = Vec::new();
    let mut block = Vec::new();
    while values.len() < count {
        let wanted = (BLOCK / N).min(count - values.len());
        block.clear();
        stream.take((wanted * N) as u64).read_to_end(&mut block).map_err(Fault::Read)?;
        if block.len() < wanted * N {
            return Err(Fault::Short { bytes: (values.len() * N + block.len()) as u64 });
        }
        values.try_reserve(wanted).map_err(|_| Fault::Memory)?;
        values.extend(block.as_chunks::<N>().0.iter().map(|bytes| number(*bytes)));
    }
    match stream.take(1).read_to_end(&mut block) {
        Ok(0) => Ok(values),
        Ok(_) => Err(Fault::Long),
        Err(e) => Err(Fault::Read(e)),
    }
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

/// `count` numbers between white space. `text` is the whole of them, so memory is bounded by what was read.
pub fn text(text: &str, voxel_type: VoxelType, count: usize) -> Result<Voxels, TextFault> {
    macro_rules! typed {
        ($variant:ident, $type:ty) => {
            Voxels::$variant(parsed::<$type>(text, count)?)
        };
    }
    Ok(match voxel_type {
        VoxelType::U8 => typed!(U8, u8),
        VoxelType::I8 => typed!(I8, i8),
        VoxelType::U16 => typed!(U16, u16),
        VoxelType::I16 => typed!(I16, i16),
        VoxelType::U32 => typed!(U32, u32),
        VoxelType::I32 => typed!(I32, i32),
        VoxelType::F32 => typed!(F32, f32),
        VoxelType::F64 => typed!(F64, f64),
    })
}

fn parsed<T: std::str::FromStr>(text: &str, count: usize) -> Result<Vec<T>, TextFault> {
    let found = text.split_ascii_whitespace().count();
    if found != count {
        return Err(TextFault::Count(found));
    }
    let mut values = Vec::new();
    values.try_reserve_exact(count).map_err(|_| TextFault::Memory)?;
    for (i, word) in text.split_ascii_whitespace().enumerate() {
        values.push(word.parse().map_err(|_| TextFault::Number(i, word.chars().take(LONGEST_SHOWN).collect()))?);
    }
    Ok(values)
}

/// Characters of a wrong number that an error shows.
const LONGEST_SHOWN: usize = 40;
